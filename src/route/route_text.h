// Checks of single routes and AOVs, shared by the parser of their text and the compiler. It must
// not know automata.
#pragma once

#include <cstddef>
#include <string>

#include "route/expression.h"

namespace nephroid {

/// Throws UsageError if `name` is not a valid layer name.
void check_layer_name(const std::string& name, const ExpressionSource& source);

/// True if `name` is a valid layer name.
bool is_layer_name(const std::string& name);
inline constexpr size_t kMaxLayerName = 64;  ///< letters

/// The location of a definition for messages, also if it was not read from a text.
ExpressionSource source_of(const ExpressionSource& source, const std::string& expression);

/// Parses an expression. Throws UsageError also if it can match no path.
Expression parse_checked(const std::string& expression, const ExpressionSource& source);

}  // namespace nephroid
