// Light path expressions as trees: what parse_expression makes of their text (docs/routes.md).
// Who calls it: the compiler, and whoever reads a route. It must not know automata or scenes.
#pragma once

#include <string>
#include <vector>

#include "route/route_set.h"
#include "route/symbols.h"

namespace nephroid {

/// Some symbols: events of some kinds, lights of some kinds, perhaps the eye; all with one label if
/// one is given.
struct SymbolPattern {
  unsigned events = 0;  ///< bits of EventKind
  unsigned lights = 0;  ///< bits of LightKind
  bool eye = false;
  std::string label;  ///< empty: any
};

/// One place in an expression: a symbol that one of the patterns has, or none of them if `negated`.
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
  std::vector<Expression> parts;  ///< of a sequence or a choice; what is repeated
  int least = 1, most = 1;        ///< of a repetition
};

/// True if any place is marked with @.
bool has_merge_mark(const Expression& e);

/// Adds labels that `labels` does not have yet, in the order of the text.
void collect_labels(const Expression& e, std::vector<std::string>& labels);

/// `expression` stands at source.column of source.text. Throws UsageError with column and caret.
Expression parse_expression(const std::string& expression, const ExpressionSource& source);

}  // namespace nephroid
