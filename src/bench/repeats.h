// The errors of a run over all of its renders: one picture is one draw, and where a few pixels hold
// most of the error another seed may say something else. Who calls it: claims, result files and
// the report. It must not know how anything is rendered.
#pragma once

#include <vector>

#include "bench/result.h"

namespace nephroid {

/// The run itself, which has not failed, and its repetitions, without those that have.
std::vector<const BenchRun*> renders_of(const BenchRun& run);

/// At the ends of all renders: the root of the mean of the squares of RMSE, the means of the
/// others.
BenchErrors errors_at_end(const BenchRun& run);
BenchNamedErrors region_errors(const BenchRun& run);
BenchNamedErrors layer_errors_at_end(const BenchRun& run);

/// The renders' own RMSEs, smallest and largest.
struct RmseRange {
  double least = 0, most = 0;
};
RmseRange rmse_range(const BenchRun& run);

}  // namespace nephroid
