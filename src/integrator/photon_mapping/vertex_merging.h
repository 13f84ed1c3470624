// `photons+light`: the paths that the camera sees through S lobes, or through a medium, are merged;
// those whose first event can be connected to the camera are found in two ways, by merging there
// and by light tracing, weighed against each other by multiple importance sampling ([X1] in
// docs/estimators.md). Merging is good while its radius is large, light tracing has no bias. It
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
