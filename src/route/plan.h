// The routes by which a picture is made, and the same compiled for a scene and proved.
// It must not know estimators' insides.
#pragma once

#include <memory>
#include <vector>

#include "route/compile.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// The routes by which a picture is made.
struct RoutePlan {
  std::vector<RouteDefinition> routes;
  std::vector<AovDefinition> aovs;
  bool strict = false;  ///< overlaps are errors
};

struct CompiledPlan {
  std::shared_ptr<const SceneSymbols> symbols;
  RouteCompilation compilation;
  bool strict = false;
};

/// Throws UsageError for an expression that is wrong; what the proof found is in the compilation.
CompiledPlan compile_plan(const RoutePlan& plan, const Scene& scene);

}  // namespace nephroid
