// Deterministic automata over symbol classes: one subset construction over all expressions of a set
// of routes, and minimisation. It must not know scenes.
#pragma once

#include <compare>
#include <span>
#include <string>
#include <vector>

#include "route/nfa.h"
#include "route/route_set.h"
#include "route/symbol_classes.h"

namespace nephroid {

/// Reads words from C on. An event may be marked as the merge vertex. The state `dead` cannot be
/// left and belongs to no route.
struct Automaton {
  size_t events = 0, lights = 0;      ///< numbers of classes
  std::vector<int> next, merge_next;  ///< [state][event class]
  std::vector<int> output;            ///< [state][light class], output of the word that ends there
  int start = 0, dead = 0;

  size_t states() const { return lights == 0 ? 0 : output.size() / lights; }
  size_t cell(int state, int event) const { return static_cast<size_t>(state) * events + event; }
  int after(int state, int event) const { return next[cell(state, event)]; }
  int after_merge(int state, int event) const { return merge_next[cell(state, event)]; }
  int at(int state, int light) const { return output[static_cast<size_t>(state) * lights + light]; }
};

/// The routes and AOVs that match a word, by their sorted numbers.
struct WordMatches {
  std::vector<int> routes, aovs;
  bool is_marked = false;
  bool touches_hair = false;
  std::vector<int> marked_by;  ///< routes that merge exactly where the word is marked
  auto operator<=>(const WordMatches&) const = default;
};

/// An automaton whose outputs are indices of `matches`; all its states are reachable.
struct MatchAutomaton {
  Automaton automaton;
  std::vector<WordMatches> matches;
};

/// The copies of expressions in the nondeterministic automaton.
struct ExpressionCopies {
  size_t routes = 0, aovs = 0;
  std::vector<int> marked_copy;  ///< [route]: the copy that obeys marks, or -1
  /// The first copies, of routes and then AOVs, ignore marks: they read a marked event as the
  /// event. The others read marked events only where the expression has a mark.
  size_t first_marked() const { return routes + aovs; }
};

/// Throws UsageError if there are too many states.
MatchAutomaton determinise(const Nfa& nfa, const SymbolClasses& classes,
                           const ExpressionCopies& copies);

/// The smallest automaton with the same outputs; its states are in breadth-first order from the
/// start.
Automaton minimise(const Automaton& automaton);

}  // namespace nephroid
