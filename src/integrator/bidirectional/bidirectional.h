// Bidirectional path tracing: for each camera path of a pixel a light path, and all ways to connect
// the two. Light paths that the camera sees expose pixels all over the film.
// Papers: Lafortune & Willems 1993; Veach & Guibas 1994; Veach 1997, chapter 10.
#pragma once

#include "film/splats.h"
#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

class Bidirectional final : public Estimator {
 public:
  Bidirectional(OwnedRoutes owned, const IntegratorOptions& options);
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return statistics_; }

  /// What a pass takes for each pixel.
  static constexpr size_t bytes_per_pixel(size_t parts) {
    return SplatBuffer::bytes_per_pixel(parts) + parts * sizeof(Rgb);
  }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
