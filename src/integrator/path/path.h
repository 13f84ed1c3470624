// `path`: path tracing with next-event estimation, for the paths that its routes own. MIS weights
// are per class of the sampled lobe, so both techniques leave out the same paths of other routes
// (docs/estimators.md, section 2).
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
  bool records_pixels() const override { return true; }
  void record_pixel(const PixelPass& pixel, const Learned*, PathTally& tally) const override;

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  int samples_per_pass_;
  bool finds_something_;  ///< the group owns some path that is possible in the scene
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
