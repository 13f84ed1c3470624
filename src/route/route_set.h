// A set of routes as the user wrote it: names, light path expressions and the estimators that own
// them; presets, the text of --route and --aov, and files of routes. The first route that matches a
// path owns it. Grammar: docs/routes.md.
// Who calls it: session, to read options; compile.h. It must not know scenes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid {

/// What can own a route. The rows of estimator_types() say what each can do.
enum class EstimatorKind : uint8_t {
  kPath,
  kPhotons,
  kSppm,
  kLightTrace,
  kPhotonsAndLight,
  kBidirectional,
  kVcm,
  kBpm,
  kMetropolis,
  kPhotonMap,
  kPpm,
  kPointLights,
  kForecast,
  kPrimarySpace
};

struct EstimatorType {
  EstimatorKind kind;
  const char* name;  ///< as routes write it: path, photons, sppm, lighttrace, photons+light
  const char* help;  ///< one sentence
  bool merges;       ///< each of its paths must have exactly one vertex where photons are merged
  bool connects;     ///< light paths are connected to the camera
  bool starts_at_lights;  ///< light that a medium emits or that touches hair is out of its reach
  bool one_route_each = false;  ///< each of its routes is a group of its own, with its own photons
};
std::span<const EstimatorType> estimator_types();
const EstimatorType& estimator_type(EstimatorKind kind);

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
  EstimatorKind estimator = EstimatorKind::kPath;
  ExpressionSource source;
};

/// A layer of the picture: the light of all paths that match, whoever renders them.
struct AovDefinition {
  std::string name;
  std::string expression;
  ExpressionSource source;
};

/// "NAME=EXPRESSION:ESTIMATOR" and "NAME=EXPRESSION". Throw UsageError with column, caret and what
/// was expected; the expression itself is checked too.
RouteDefinition parse_route(const std::string& text, const std::string& where = "--route");
AovDefinition parse_aov(const std::string& text, const std::string& where = "--aov");

/// One route a line, # begins a comment. `file` is for messages: "FILE:LINE: ...". Throws
/// UsageError.
std::vector<RouteDefinition> parse_route_file(const std::string& text, const std::string& file);

struct RoutePreset {
  const char* name;
  const char* help;
  std::vector<const char*> routes;  ///< as parse_route reads them
};
/// doidge2012, classic, split, all-photons, path-only, sppm, ...
std::span<const RoutePreset> route_presets();
/// Empty if there is none of that name.
std::optional<std::vector<RouteDefinition>> route_preset(const std::string& name);

}  // namespace nephroid
