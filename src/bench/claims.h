// Judges the claims of a suite by its figures. It must not know how the figures were measured.
#pragma once

#include "bench/result.h"

namespace nephroid {

/// The figure of a run for a claim's metric. Empty if there is none: a slope of too few points,
/// memory in which nothing was stored. Errors at the end are over all renders of the run, other
/// figures are those of the first one.
std::optional<double> metric_of(const BenchRun& run, const BenchClaim& claim);

/// A verdict for each claim of the suite, over the scenes that were run. A claim fails if a figure
/// fails; it holds if all its figures were measured and hold.
std::vector<BenchVerdict> judge_claims(const BenchResults& results);

}  // namespace nephroid
