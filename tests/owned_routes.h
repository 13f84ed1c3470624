// Compiles routes for tests that call integrator passes directly.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrator/presets/estimator_table.h"
#include "route/compile.h"
#include "route/scene_symbols.h"

namespace nephroid::testing_support {

/// The routes of these texts (as for --route) in a scene, whatever the proof finds. `group` counts
/// estimators in the order in which the texts name them.
inline OwnedRoutes owned_routes(const Scene& scene, const std::vector<std::string>& texts,
                                size_t group = 0) {
  std::vector<RouteDefinition> definitions;
  for (const std::string& text : texts)
    definitions.push_back(parse_route(text, estimator_traits()));
  RouteCompilation compiled = compile_routes(definitions, {});
  OwnedRoutes owned;
  owned.symbols = std::make_shared<const SceneSymbols>(scene, compiled.routes.labels());
  owned.routes = std::make_shared<const Routes>(std::move(compiled.routes));
  owned.group = group;
  return owned;
}

}  // namespace nephroid::testing_support
