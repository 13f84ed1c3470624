// `photons+light`: paths whose first event can be connected to the camera are found by merging and
// by light tracing, combined by MIS ([X1] in docs/estimators.md); all others by merging alone. It
// must not know how photons are traced. Papers: Georgiev, Krivanek, Davidovic, Slusallek 2012;
// Hachisuka, Pantaleoni, Jensen 2012.
#pragma once

#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

class VertexMerging : public Estimator {
 public:
  VertexMerging(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool photons_can_count_;
  uint64_t found_ = 0;  ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
