// The one table of integrators: names that stand for sets of routes.
#pragma once

#include <string>
#include <vector>

#include "input/format_rows.h"
#include "integrator/presets/estimator_set.h"

namespace nephroid {

/// Names of the table: "path", "sppm", "mixed".
std::vector<std::string> integrator_names();
/// The integrator that stands for a pbrt-v4 name ("volpath" -> "path" ...); empty if there is none.
std::string integrator_for_scene_name(const std::string& pbrt_name);
/// All integrators of the format; refused are those for which nothing stands here.
std::vector<FormatType> scene_integrator_types();

/// The plan that an integrator's name stands for. Throws UsageError for an unknown name.
RoutePlan plan_of_integrator(const std::string& name);
/// make_estimators of the plan that a name stands for.
EstimatorSet make_integrator(const std::string& name, const IntegratorOptions& options,
                             const Scene& scene);

}  // namespace nephroid
