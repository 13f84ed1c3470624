// Nondeterministic automata of several expressions side by side (Thompson 1968).
// Who calls it: the compiler, and the check that an expression matches anything at all.
// It must not know routes or symbols.
#pragma once

#include <map>
#include <vector>

#include "route/expression.h"

namespace nephroid {

struct Nfa {
  static constexpr int kNone = -1;
  /// Reads a symbol and goes to `next`; or, without an atom, goes to `next` and `other` reading
  /// nothing. The state that accepts has neither.
  struct State {
    int atom = kNone;
    int next = kNone, other = kNone;
    int copy = 0;  ///< which of the expressions it belongs to
  };
  std::vector<State> states;
  std::vector<const ExpressionAtom*> atoms;
  std::vector<int> starts, accepts;  ///< [copy]

  /// One more copy of an expression, which must outlive the automaton. Throws UsageError where
  /// `source` says if the automaton grows too large.
  void add(const Expression& expression, const ExpressionSource& source);
  size_t copies() const { return starts.size(); }

 private:
  int new_state(const State& state, const ExpressionSource& source);
  /// States that read what `e` matches and then are in `next`; returns the first.
  int build(const Expression& e, int next, int copy, const ExpressionSource& source);
  int build_repetition(const Expression& e, int next, int copy, const ExpressionSource& source);

  std::map<const ExpressionAtom*, int> atom_numbers_;
};

/// True if some path C e1 ... en l matches.
bool matches_some_path(const Expression& expression, const ExpressionSource& source);

}  // namespace nephroid
