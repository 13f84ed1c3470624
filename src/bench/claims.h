// Whether the figures of a suite bear its claims out.
// Who calls it: bench.cpp. It must not know how the figures came about.
#pragma once

#include "bench/result.h"

namespace nephroid {

/// The figure of a run that a claim speaks of; empty if the run cannot tell (a slope of too few
/// points, memory that nothing was stored in). Errors at the end are those of all its renders,
/// other figures those of the first.
std::optional<double> metric_of(const BenchRun& run, const BenchClaim& claim);

/// A verdict for each claim of the suite, over the scenes that were run. A claim fails if one
/// figure does, and is not measured if there is none.
std::vector<BenchVerdict> judge_claims(const BenchResults& results);

}  // namespace nephroid
