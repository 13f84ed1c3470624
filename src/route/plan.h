// The routes of a picture, and the same routes compiled and proved for a scene. It must not know
// estimators.
#pragma once

#include <memory>
#include <vector>

#include "route/compile.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// The routes and AOVs of a picture.
struct RoutePlan {
  std::vector<RouteDefinition> routes;
  std::vector<AovDefinition> aovs;
  bool strict = false;          ///< true: overlaps are errors
  bool has_own_routes = false;  ///< true: the user wrote them, so none should stay black
};

struct CompiledPlan {
  std::shared_ptr<const SceneSymbols> symbols;
  RouteCompilation compilation;
  bool strict = false;
  bool has_own_routes = false;
};

/// Compiles a plan for a scene. Throws UsageError for a wrong expression. Findings of the proof are
/// in the compilation.
CompiledPlan compile_plan(const RoutePlan& plan, const Scene& scene);

}  // namespace nephroid
