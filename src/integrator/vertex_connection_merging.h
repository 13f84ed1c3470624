// Vertex connection and merging: everything that bidirectional path tracing does, and eye paths are
// merged with the vertices of all light paths of the pass as well. Where routes name `bpm` nothing
// is connected but lights: bidirectional photon mapping. Wavelengths and time are the pass's. One
// set of light paths is merged and connected to the camera, another, one for each camera path, is
// connected to it: nothing is kept but photons, in batches that fit in memory.
// Papers: Georgiev et al. 2012; Hachisuka, Pantaleoni & Jensen 2012; Vorba 2011.
#pragma once

#include "film/splats.h"
#include "integrator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

class VertexConnectionMerging final : public Estimator {
 public:
  VertexConnectionMerging(OwnedRoutes owned, const IntegratorOptions& options);
  Capabilities capabilities() const override { return {}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override { return statistics_; }

  /// What a pass takes for each pixel.
  static constexpr size_t bytes_per_pixel(size_t parts) {
    return SplatBuffer::bytes_per_pixel(parts) + parts * sizeof(Rgb) + sizeof(float);
  }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
