// Features at the first vertex of camera paths: albedo, normal and depth for every film, and the
// geometric layers of a gbuffer film. It must not know routes or channels.
#pragma once

#include "integrator/estimator/estimator.h"
#include "integrator/estimator/surface_sample.h"
#include "transport/camera_path.h"

namespace nephroid {

/// The features of one camera path.
class Features {
 public:
  /// Records the first vertex; later calls do nothing.
  void record(const Walk& walk, const WalkVertex& v);
  /// Adds one sample of a pixel to the film's features. `weights` belong to the path's wavelengths.
  void add_to(Film& film, int x, int y, const Scene& scene, const CameraPath& path,
              const SensorWeights& weights) const;

 private:
  SampledSpectrum albedo_;
  Vec3f normal_{0, 0, 0};
  float depth_ = 0;  ///< 0: no surface seen
  FirstSurface surface_;
};

/// Adds features and no light: one sample per pixel and pass.
class FeatureEstimator : public Estimator {
 public:
  const EstimatorDescriptor& descriptor() const override;
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override {
    EstimatorStatistics s = statistics_;
    s.tells_lamps = true;
    return s;
  }

 private:
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
