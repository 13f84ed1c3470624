// Learns where the photons of an estimator should start and where they should go from rough
// surfaces: what the camera sees through its routes is scattered over the scene as points, photons
// are traced in a few rounds, and the paths of those that land near such a point make the guide,
// each round with what the rounds before have learned. A function of scene, film, options and seed
// alone: every pass of a render, wherever it is rendered, has the same guide (docs/estimators.md,
// section 20). Who calls it: photon integrators. It must not know how photons are merged.
#pragma once

#include <optional>

#include "integrator/estimator/estimator.h"
#include "photon/photon_guide.h"
#include "route/scene_symbols.h"

namespace nephroid {

class LearnedPhotons {
 public:
  /// The guide for the passes of a seed; learned when it is asked for the first time, and its rays
  /// counted then. That of path+photons has no casters: ADR 25.
  const PhotonGuide& guide(uint64_t seed, const Scene& scene, const Film& film,
                           const OwnedRoutes& owned, const IntegratorOptions& options,
                           EstimatorStatistics& statistics);
  /// What was learned, in words.
  void add_notes(EstimatorStatistics& statistics) const;

 private:
  std::optional<PhotonGuide> guide_;
  uint64_t seed_ = 0;
};

}  // namespace nephroid
