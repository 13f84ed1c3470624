// Sets of routes that have a name. Their expressions: docs/routes.md.
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
  std::vector<const char*> routes;  ///< as parse_route reads them
};
/// doidge2012, classic, split, all-photons, path-only, sppm, ...
std::span<const RoutePreset> route_presets();
/// Empty if there is none of that name.
std::optional<std::vector<RouteDefinition>> route_preset(const std::string& name);

}  // namespace nephroid
