// Light path expressions as syntax trees (docs/routes.md). It must not know automata or scenes.
#pragma once

#include <string>
#include <vector>

#include "route/route_set.h"
#include "route/symbols.h"

namespace nephroid {

/// A set of symbols: events and lights of some kinds, or the eye. If a label is given, only symbols
/// with this label.
struct SymbolPattern {
  unsigned events = 0;  ///< bits of EventKind
  unsigned lights = 0;  ///< bits of LightKind
  bool eye = false;
  std::string label;  ///< empty: any
};

/// One place in an expression: a symbol in one of the patterns or, if `negated`, in none of them.
struct ExpressionAtom {
  std::vector<SymbolPattern> any_of;
  bool negated = false;
  bool merges = false;  ///< marked with @
};

struct Expression {
  enum class Kind { kAtom, kSequence, kChoice, kRepeat };
  static constexpr int kUnbounded = -1;

  Kind kind = Kind::kAtom;
  ExpressionAtom atom;
  std::vector<Expression> parts;  ///< parts of a sequence or a choice, or the repeated part
  int least = 1, most = 1;        ///< bounds of a repetition
};

/// True if any place is marked with @.
bool has_merge_mark(const Expression& e);

/// Appends the expression's labels that `labels` does not have yet, in the order of the text.
void collect_labels(const Expression& e, std::vector<std::string>& labels);

/// Parses `expression`, which is at source.column of source.text. Throws UsageError with column and
/// caret.
Expression parse_expression(const std::string& expression, const ExpressionSource& source);

}  // namespace nephroid
