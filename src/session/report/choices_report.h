// What estimators chose and found, in sentences: photons, radii, where the rays went, their own
// notes, and how far off they take themselves to be. It must not know clocks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "integrator/estimator/estimator.h"

namespace nephroid {

/// Lines, without ends, for all estimators of a render: their statistics after the first pass and
/// after the last of `passes`.
std::vector<std::string> choices_report(const std::vector<EstimatorStatistics>& first,
                                        const std::vector<EstimatorStatistics>& last,
                                        uint32_t passes);

/// A line for each route of estimators that count it (`bdpt`, `vcm`, `bpm`, `path+photons`): which
/// of their techniques carried its light in passes 0 to 7, if these were rendered.
std::vector<std::string> technique_report(const std::vector<EstimatorStatistics>& statistics);

/// A line of the errors that the film claims for itself, by the routes that are sampled together;
/// empty while it claims none.
std::optional<std::string> error_report(const Film& film);

}  // namespace nephroid
