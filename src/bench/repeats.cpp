#include "bench/repeats.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

/// Mean of the errors `part(render)` over all renders.
template <class Part>
BenchErrors mean_over(const std::vector<const BenchRun*>& renders, const Part& part) {
  BenchErrors mean;
  for (const BenchRun* run : renders) {
    const BenchErrors& e = part(*run);
    mean.rmse += e.rmse * e.rmse;
    mean.relmse += e.relmse;
    mean.relmse_trim += e.relmse_trim;
    mean.mean_error += e.mean_error;
    mean.flip += e.flip;
  }
  const double count = static_cast<double>(renders.size());
  return {std::sqrt(mean.rmse / count), mean.relmse / count, mean.relmse_trim / count,
          mean.mean_error / count, mean.flip / count};
}

/// Means by name; all renders have the same names in the same order.
template <class List>
BenchNamedErrors means_over(const BenchRun& run, const List& list) {
  const std::vector<const BenchRun*> renders = renders_of(run);
  BenchNamedErrors means;
  for (size_t i = 0; i < list(run).size(); ++i)
    means.emplace_back(list(run)[i].first,
                       mean_over(renders, [&](const BenchRun& r) -> const BenchErrors& {
                         return list(r).at(i).second;
                       }));
  return means;
}

}  // namespace

std::vector<const BenchRun*> renders_of(const BenchRun& run) {
  std::vector<const BenchRun*> renders = {&run};
  for (const BenchRun& again : run.again)
    if (again.failure.empty()) renders.push_back(&again);
  return renders;
}

BenchErrors errors_at_end(const BenchRun& run) {
  return mean_over(renders_of(run),
                   [](const BenchRun& r) -> const BenchErrors& { return r.end().errors; });
}

BenchNamedErrors region_errors(const BenchRun& run) {
  return means_over(run, [](const BenchRun& r) -> const BenchNamedErrors& { return r.regions; });
}

BenchNamedErrors layer_errors_at_end(const BenchRun& run) {
  return means_over(run,
                    [](const BenchRun& r) -> const BenchNamedErrors& { return r.end().layers; });
}

RmseRange rmse_range(const BenchRun& run) {
  RmseRange range{run.end().errors.rmse, run.end().errors.rmse};
  for (const BenchRun* render : renders_of(run)) {
    range.least = std::min(range.least, render->end().errors.rmse);
    range.most = std::max(range.most, render->end().errors.rmse);
  }
  return range;
}

}  // namespace nephroid
