// `lighttrace`: light paths whose vertices are connected to the camera, and the start points of
// those on shapes as well. It finds what is seen directly of caustics, without any bias. A pass is
// a function of the scene, the options and the pass key alone, so passes may be rendered anywhere
// and added up. Papers: Dutre, Lafortune, Willems 1993; Veach 1997, chapters 5 and 10.
#pragma once

#include "integrator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// Throws UsageError if light paths cannot be connected to the scene's camera.
void require_connecting_camera(const Scene& scene);

class LightTracing : public Estimator {
 public:
  LightTracing(OwnedRoutes owned, const IntegratorOptions& options);

  Capabilities capabilities() const override { return {}; }
  /// Throws as require_connecting_camera.
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override;

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  uint64_t splats_ = 0;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
