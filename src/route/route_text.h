// Checks of single routes and AOVs that the reader of their text and the compiler share.
// Who calls it: route_text.cpp and compile.cpp. It must not know automata.
#pragma once

#include <string>

#include "route/expression.h"

namespace nephroid {

/// Throws UsageError if `name` is no name for a layer of the picture.
void check_layer_name(const std::string& name, const ExpressionSource& source);

/// Where to point at in messages about a definition, also one that was not read from a text.
ExpressionSource source_of(const ExpressionSource& source, const std::string& expression);

/// Parses, and throws UsageError too if the expression can match no path at all.
Expression parse_checked(const std::string& expression, const ExpressionSource& source);

}  // namespace nephroid
