// The table of integrators: names that stand for route presets.
#pragma once

#include <string>
#include <vector>

#include "input/format_rows.h"
#include "integrator/presets/estimator_set.h"

namespace nephroid {

/// Names of the table: "path", "sppm", "mixed".
std::vector<std::string> integrator_names();
/// The substitute for a pbrt-v4 integrator ("volpath" -> "path" ...); empty if there is none.
std::string integrator_for_scene_name(const std::string& pbrt_name);
/// All integrators of the format; those without a substitute are refused.
std::vector<FormatType> scene_integrator_types();

/// The plan of an integrator. Throws UsageError for an unknown name.
RoutePlan plan_of_integrator(const std::string& name);
/// make_estimators for the plan of an integrator.
EstimatorSet make_integrator(const std::string& name, const IntegratorOptions& options,
                             const Scene& scene);

}  // namespace nephroid
