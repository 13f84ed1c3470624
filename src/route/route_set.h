// Routes and AOVs as the user wrote them: names, light path expressions and estimators. The first
// route that matches a path owns it (docs/routes.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "route/estimator_traits.h"

namespace nephroid {

/// The location of an expression, for messages: the user's text, and the expression's first column
/// in it (from 0).
struct ExpressionSource {
  std::string where;  ///< "--route", "--aov", "preset doidge2012" or "FILE:LINE"
  std::string text;
  size_t column = 0;
};

struct RouteDefinition {
  std::string name;  ///< also the name of its layer in the picture
  std::string expression;
  const EstimatorTraits* estimator = nullptr;  ///< renders its paths
  ExpressionSource source;
};

/// A layer of the picture with the light of all matching paths, whichever estimator renders them.
struct AovDefinition {
  std::string name;
  std::string expression;
  ExpressionSource source;
  std::string route = {};  ///< route whose paths alone count; empty: those of all routes
  std::string light = {};  ///< lamp of a layer by light (session/light_layers.h); empty: none
};

/// Parse and check "NAME=EXPRESSION:ESTIMATOR" and "NAME=EXPRESSION". The estimator is one of
/// `estimators`, which must outlive the route. Throw UsageError with column and caret.
RouteDefinition parse_route(const std::string& text, TraitsTable estimators,
                            const std::string& where = "--route");
AovDefinition parse_aov(const std::string& text, const std::string& where = "--aov");

/// Parses a file with one route a line; # begins a comment. `file` is its name for messages. Throws
/// UsageError.
std::vector<RouteDefinition> parse_route_file(const std::string& text, TraitsTable estimators,
                                              const std::string& file);

}  // namespace nephroid
