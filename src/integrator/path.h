// `path`: unidirectional path tracing with next-event estimation, for the words that a route owns.
// Each technique's share is weighed per class of the sampled lobe, so that a path which belongs to
// another route is left out by both techniques alike (docs/estimators.md, section 2).
#pragma once

#include "integrator/estimator.h"
#include "route/routes.h"

namespace nephroid {

class PathEstimator : public Estimator {
 public:
  /// Renders what `routes` says belongs to `route` into the film's buffer `buffer`.
  PathEstimator(const Routes& routes, Route route, int buffer, const IntegratorOptions& options);

  Capabilities capabilities() const override { return {}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  Routes routes_;
  Route route_;
  int buffer_;
  int max_depth_;
  int samples_per_pass_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
