// A set of routes as the user wrote it: names, light path expressions and the estimators that own
// them. The first route that matches a path owns it. Grammar: docs/routes.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "route/estimator_traits.h"

namespace nephroid {

/// Where an expression stands, for messages: the text as the user wrote it and the column (from 0)
/// at which the expression begins in it.
struct ExpressionSource {
  std::string where;  ///< "--route", "--aov", "preset doidge2012" or "FILE:LINE"
  std::string text;
  size_t column = 0;
};

struct RouteDefinition {
  std::string name;  ///< also the name of its layer in the picture
  std::string expression;
  const EstimatorTraits* estimator = nullptr;  ///< who renders its paths
  ExpressionSource source;
};

/// A layer of the picture: the light of all paths that match, whoever renders them.
struct AovDefinition {
  std::string name;
  std::string expression;
  ExpressionSource source;
};

/// "NAME=EXPRESSION:ESTIMATOR" with one of `estimators`, which must outlive the route, and
/// "NAME=EXPRESSION". Throw UsageError with column, caret and what was expected; the expression
/// itself is checked too.
RouteDefinition parse_route(const std::string& text, TraitsTable estimators,
                            const std::string& where = "--route");
AovDefinition parse_aov(const std::string& text, const std::string& where = "--aov");

/// One route a line, # begins a comment. `file` is for messages: "FILE:LINE: ...". Throws
/// UsageError.
std::vector<RouteDefinition> parse_route_file(const std::string& text, TraitsTable estimators,
                                              const std::string& file);

}  // namespace nephroid
