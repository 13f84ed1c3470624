// Notes for the report: why photons brought no light, and where the caustics of glossy materials
// are. They follow from counts and symbols alone; it must not know walks.
#pragma once

#include "integrator/estimator/estimator_statistics.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// Says why photons brought no light, if they brought none; `found` photons were merged.
void explain_darkness(const OwnedRoutes& owned, uint64_t found, EstimatorStatistics& statistics);

/// The same for caustics of the default integrator, from its counts of traced and useful paths.
/// Adds nothing if the scene has no specular materials.
void explain_missing_caustics(const OwnedRoutes& owned, EstimatorStatistics& statistics);

/// Says which light the caustics of glossy materials belong to, if the scene has no specular
/// materials. `by_path_tracing`: no photons were traced.
void explain_glossy_caustics(const OwnedRoutes& owned, bool by_path_tracing,
                             EstimatorStatistics& statistics);

}  // namespace nephroid
