// What estimators chose and found, in sentences: photons, radii, where the rays went, and their own
// notes. Who calls it: the session, for the picture's metadata, and the program, for the end of a
// render. It must not know clocks.
#pragma once

#include <string>
#include <vector>

#include "integrator/estimator.h"

namespace nephroid {

/// Lines, without ends, for all estimators of a preset: their statistics after the first pass and
/// after the last of `passes`.
std::vector<std::string> choices_report(const std::vector<EstimatorStatistics>& first,
                                        const std::vector<EstimatorStatistics>& last,
                                        uint32_t passes);

}  // namespace nephroid
