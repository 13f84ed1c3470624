// Notes for the report: why no photon brought light, and where the caustics of glossy materials
// are. Of counts and symbols alone; it must not know walks.
#pragma once

#include "integrator/estimator/estimator_statistics.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// Says why there is no light from photons, if there is none; `found` is how many were merged.
void explain_darkness(const OwnedRoutes& owned, uint64_t found, EstimatorStatistics& statistics);

/// The same for caustics of the default integrator, from the paths that were traced and how many
/// were of use. Of a scene without specular materials nothing is said.
void explain_missing_caustics(const OwnedRoutes& owned, EstimatorStatistics& statistics);

/// Of a scene without specular materials: where the caustics of its glossy ones are.
/// `by_path_tracing`: no photons were traced.
void explain_glossy_caustics(const OwnedRoutes& owned, bool by_path_tracing,
                             EstimatorStatistics& statistics);

}  // namespace nephroid
