// Route presets: named sets of routes (docs/routes.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "route/route_set.h"

namespace nephroid {

struct RoutePreset {
  const char* name;
  const char* help;
  std::vector<const char*> routes;  ///< routes in the syntax of parse_route
};
/// All presets: doidge2012, classic, split, all-photons, path-only, sppm, ...
std::span<const RoutePreset> route_presets();
/// The routes of a preset; empty if the name is unknown.
std::optional<std::vector<RouteDefinition>> route_preset(const std::string& name);

}  // namespace nephroid
