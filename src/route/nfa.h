// A nondeterministic automaton with several expressions (Thompson 1968). It must not know routes or
// symbols.
#pragma once

#include <map>
#include <vector>

#include "route/expression.h"

namespace nephroid {

struct Nfa {
  static constexpr int kNone = -1;
  /// With an atom, reads a symbol and goes to `next`. Without one, goes to `next` and `other` and
  /// reads nothing. An accepting state has none of them.
  struct State {
    int atom = kNone;
    int next = kNone, other = kNone;
    int copy = 0;  ///< index of its expression
  };
  std::vector<State> states;
  std::vector<const ExpressionAtom*> atoms;
  std::vector<int> starts, accepts;  ///< [copy]

  /// Adds a copy of an expression, which must outlive the automaton. Throws UsageError located at
  /// `source` if the automaton grows too large.
  void add(const Expression& expression, const ExpressionSource& source);
  size_t copies() const { return starts.size(); }

 private:
  int new_state(const State& state, const ExpressionSource& source);
  /// Adds states that read `e` and then are in `next`; returns the first one.
  int build(const Expression& e, int next, int copy, const ExpressionSource& source);
  int build_repetition(const Expression& e, int next, int copy, const ExpressionSource& source);

  std::map<const ExpressionAtom*, int> atom_numbers_;
};

/// True if some path C e1 ... en l matches.
bool matches_some_path(const Expression& expression, const ExpressionSource& source);

}  // namespace nephroid
