// `path`: unidirectional path tracing with next-event estimation, for the words of the routes that
// it owns. Each technique's share is weighed per class of the sampled lobe, so that a path which
// belongs to another route is left out by both techniques alike (docs/estimators.md, section 2).
#pragma once

#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

class PathEstimator : public Estimator {
 public:
  PathEstimator(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  bool records_features() const override { return finds_something_; }
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  int samples_per_pass_;
  bool finds_something_;  ///< some path that the scene can have is the group's
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
