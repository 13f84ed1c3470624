// The errors of a run over all of its renders. One picture is one sample: if a few pixels have most
// of the error, another seed may give another result. It must not know how anything is rendered.
#pragma once

#include <vector>

#include "bench/result.h"

namespace nephroid {

/// A run that has not failed, and its repetitions that have not failed.
std::vector<const BenchRun*> renders_of(const BenchRun& run);

/// Errors at the ends of all renders: root mean square for RMSE, mean for the others.
BenchErrors errors_at_end(const BenchRun& run);
BenchNamedErrors region_errors(const BenchRun& run);
BenchNamedErrors layer_errors_at_end(const BenchRun& run);

/// The smallest and the largest RMSE of the renders.
struct RmseRange {
  double least = 0, most = 0;
};
RmseRange rmse_range(const BenchRun& run);

}  // namespace nephroid
