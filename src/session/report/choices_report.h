// Reports what estimators chose and found: photons, radii, rays, notes and estimated errors. It
// must not know clocks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "integrator/estimator/estimator.h"

namespace nephroid {

/// Report lines of all estimators, from their statistics after the first pass and after the last of
/// `passes`.
std::vector<std::string> choices_report(const std::vector<EstimatorStatistics>& first,
                                        const std::vector<EstimatorStatistics>& last,
                                        uint32_t passes);

/// A line per route with the shares of the techniques in its light, from passes 0 to 7 if these
/// were rendered. Only `bdpt`, `vcm`, `bpm` and `path+photons` count them.
std::vector<std::string> technique_report(const std::vector<EstimatorStatistics>& statistics);

/// Says how pixels look that the first pass of a film has not reached yet.
std::string text_of_unreached_pixels(const Film& film);

/// A line with the film's estimated errors, by the routes that are sampled together. Empty while
/// there is no estimate.
std::optional<std::string> error_report(const Film& film);

}  // namespace nephroid
