// Makes a route plan from the command line: routes of an integrator, a preset, a file or single
// routes. It must not know scenes.
#pragma once

#include <string>
#include <vector>

#include "integrator/presets/estimator_set.h"
#include "session/light_layers.h"

namespace nephroid {

/// --integrator, --routes, --route, --aov, --layers and --strict-routes as given.
struct RouteChoice {
  std::string integrator;  ///< empty: not given
  const std::string& integrator_or(const std::string& other) const {
    return integrator.empty() ? other : integrator;
  }
  std::string preset_or_file;
  std::vector<RouteDefinition> routes;
  std::vector<AovDefinition> aovs;
  LayerChoice layers = LayerChoice::kRoutes;  ///< of use to a render: layers by light need a scene
  bool strict = false;
};

/// `integrator` is used if neither routes nor a preset are given. Throws UsageError for more than
/// one source of routes, an unknown preset and errors in a file; IoError if the file cannot be
/// read.
RoutePlan plan_of(const RouteChoice& choice, const std::string& integrator);

/// The plan's source, for the picture's metadata: "mixed", "split", "routes.txt", "--route".
std::string name_of(const RouteChoice& choice, const std::string& integrator);

/// The routes of a plan in the format of a route file, and its AOVs in the same form.
std::string routes_text(const RoutePlan& plan);
std::string aovs_text(const RoutePlan& plan);

}  // namespace nephroid
