// Deterministic automata over classes of symbols: subset construction over all expressions of a set
// of routes at once, and minimisation.
// Who calls it: the compiler and the proof. It must not know scenes.
#pragma once

#include <compare>
#include <span>
#include <string>
#include <vector>

#include "route/nfa.h"
#include "route/route_set.h"
#include "route/symbol_classes.h"

namespace nephroid {

/// Has read C and events, some of which may be marked as the vertex where photons are merged. The
/// state `dead` cannot be left and belongs to no route.
struct Automaton {
  size_t events = 0, lights = 0;      ///< classes
  std::vector<int> next, merge_next;  ///< [state][class of events]
  std::vector<int> output;            ///< [state][class of lights], of the word that ends there
  int start = 0, dead = 0;

  size_t states() const { return lights == 0 ? 0 : output.size() / lights; }
  size_t cell(int state, int event) const { return static_cast<size_t>(state) * events + event; }
  int after(int state, int event) const { return next[cell(state, event)]; }
  int after_merge(int state, int event) const { return merge_next[cell(state, event)]; }
  int at(int state, int light) const { return output[static_cast<size_t>(state) * lights + light]; }
};

/// What matches a word: numbers of routes and AOVs in order.
struct WordMatches {
  std::vector<int> routes, aovs;
  bool is_marked = false;
  bool touches_hair = false;
  std::vector<int> marked_by;  ///< routes that merge exactly where the word is marked
  auto operator<=>(const WordMatches&) const = default;
};

/// Outputs are indices of `matches`; all states are reached.
struct MatchAutomaton {
  Automaton automaton;
  std::vector<WordMatches> matches;
};

/// The copies of the automaton of all expressions.
struct ExpressionCopies {
  size_t routes = 0, aovs = 0;
  std::vector<int> marked_copy;  ///< [route]: the copy that obeys marks, or -1
  /// Copies of routes, then of AOVs, ignore marks: a marked event is read as the event. The others
  /// read marked events where the expression has a mark, and nowhere else.
  size_t first_marked() const { return routes + aovs; }
};

/// Throws UsageError if there are too many states.
MatchAutomaton determinise(const Nfa& nfa, const SymbolClasses& classes,
                           const ExpressionCopies& copies);

/// The smallest automaton with the same outputs; its states are numbered in the order in which a
/// search in breadth from the start finds them.
Automaton minimise(const Automaton& automaton);

}  // namespace nephroid
