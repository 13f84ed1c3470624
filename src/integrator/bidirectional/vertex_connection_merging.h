// Vertex connection and merging: everything that bidirectional path tracing does, and eye paths are
// merged with the vertices of all light paths of the pass as well. Where routes name `bpm` nothing
// is connected but lights: bidirectional photon mapping.
// Papers: Georgiev et al. 2012; Hachisuka, Pantaleoni & Jensen 2012; Vorba 2011.
#pragma once

#include "integrator/bidirectional/pair_pass.h"

namespace nephroid {

/// Light paths of a pass: one for each pixel, within bounds; they are shared or spare outside.
int64_t default_light_paths(int64_t pixels);

class VertexConnectionMerging final : public Estimator {
 public:
  VertexConnectionMerging(OwnedRoutes owned, const IntegratorOptions& options);
  Capabilities capabilities() const override { return {}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
