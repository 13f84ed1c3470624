// A plan of routes, compiled for a scene and proved, before it becomes estimators: so that
// `nephroid routes` can print what the proof found and render from the same compilation.
// Who calls it: preset.cpp and the command. It must not know estimators' insides.
#pragma once

#include <memory>

#include "integrator/estimator/estimator.h"
#include "route/compile.h"
#include "route/scene_symbols.h"

namespace nephroid {

struct CompiledPlan {
  std::shared_ptr<const SceneSymbols> symbols;
  RouteCompilation compilation;
  bool strict = false;
};

/// Throws UsageError for an expression that is wrong; what the proof found is in the compilation.
CompiledPlan compile_plan(const RoutePlan& plan, const Scene& scene);

/// make_preset of a plan that is compiled already; its warnings leave out what the proof found.
Preset make_preset(CompiledPlan compiled, const IntegratorOptions& options, const Scene& scene);

}  // namespace nephroid
