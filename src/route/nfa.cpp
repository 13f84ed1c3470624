// Builds from the end: each piece gets the state that follows it.
// Paper: Thompson, Regular expression search algorithm, CACM 1968.
#include "route/nfa.h"

#include <utility>

#include "route/expression_error.h"
#include "route/symbol_classes.h"

namespace nephroid {
namespace {
constexpr size_t kMaxNfaStates = 8192;
}

int Nfa::new_state(const State& state, const ExpressionSource& source) {
  if (states.size() >= kMaxNfaStates)
    throw expression_error(source, source.column,
                           "the expressions are too long, expected at most " +
                               std::to_string(kMaxNfaStates) +
                               " places with repetitions written out");
  states.push_back(state);
  return static_cast<int>(states.size()) - 1;
}

int Nfa::build(const Expression& e, int next, int copy, const ExpressionSource& source) {
  switch (e.kind) {
    case Expression::Kind::kAtom: {
      const auto [at, is_new] = atom_numbers_.try_emplace(&e.atom, static_cast<int>(atoms.size()));
      if (is_new) atoms.push_back(&e.atom);
      return new_state({at->second, next, kNone, copy}, source);
    }
    case Expression::Kind::kSequence:
      for (size_t i = e.parts.size(); i-- > 0;) next = build(e.parts[i], next, copy, source);
      return next;
    case Expression::Kind::kChoice: {
      int first = build(e.parts.back(), next, copy, source);
      for (size_t i = e.parts.size() - 1; i-- > 0;) {
        const int other = build(e.parts[i], next, copy, source);
        first = new_state({kNone, other, first, copy}, source);
      }
      return first;
    }
    case Expression::Kind::kRepeat:
      return build_repetition(e, next, copy, source);
  }
  return next;
}

int Nfa::build_repetition(const Expression& e, int next, int copy, const ExpressionSource& source) {
  const Expression& body = e.parts[0];
  int first = next;
  if (e.most == Expression::kUnbounded) {
    first = new_state({kNone, kNone, next, copy}, source);
    const int again = build(body, first, copy, source);
    states[first].next = again;
  } else {
    for (int i = e.least; i < e.most; ++i) {
      const int once_more = build(body, first, copy, source);
      first = new_state({kNone, once_more, next, copy}, source);
    }
  }
  for (int i = 0; i < e.least; ++i) first = build(body, first, copy, source);
  return first;
}

void Nfa::add(const Expression& expression, const ExpressionSource& source) {
  const int copy = static_cast<int>(copies());
  const int accept = new_state({kNone, kNone, kNone, copy}, source);
  accepts.push_back(accept);
  starts.push_back(build(expression, accept, copy, source));
}

bool matches_some_path(const Expression& expression, const ExpressionSource& source) {
  Nfa nfa;
  nfa.add(expression, source);
  std::vector<std::string> labels;
  collect_labels(expression, labels);
  const SymbolClasses classes = classify_symbols(nfa.atoms, labels);
  const auto any = [](const std::vector<bool>& bits) {
    for (const bool bit : bits)
      if (bit) return true;
    return false;
  };
  // Each state can be reached before the eye is read, after it, or after a light.
  enum Phase { kBeforeEye, kBehindEye, kBehindLight, kPhases };
  std::vector<bool> known(nfa.states.size() * kPhases);
  std::vector<std::pair<int, int>> open;
  const auto visit = [&](int state, int phase) {
    if (state == Nfa::kNone) return;
    const size_t i = static_cast<size_t>(state) * kPhases + static_cast<size_t>(phase);
    if (!known[i]) open.emplace_back(state, phase);
    known[i] = true;
  };
  visit(nfa.starts[0], kBeforeEye);
  while (!open.empty()) {
    const auto [state, phase] = open.back();
    open.pop_back();
    if (state == nfa.accepts[0] && phase == kBehindLight) return true;
    const Nfa::State& s = nfa.states[state];
    if (s.atom == Nfa::kNone) {
      visit(s.next, phase);
      visit(s.other, phase);
      continue;
    }
    const auto atom = static_cast<size_t>(s.atom);
    if (phase == kBeforeEye && classes.reads_eye[atom]) visit(s.next, kBehindEye);
    if (phase == kBehindEye && any(classes.reads_event[atom])) visit(s.next, kBehindEye);
    if (phase == kBehindEye && any(classes.reads_light[atom])) visit(s.next, kBehindLight);
  }
  return false;
}

}  // namespace nephroid
