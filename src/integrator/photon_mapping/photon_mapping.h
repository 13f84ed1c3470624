// `photons`: stochastic progressive photon mapping with the memoryless radius [E2], storing only
// the photons of its own routes. A pass is a function of the scene, the options and the pass key
// alone, so passes may be rendered anywhere and added up. Who calls it: presets. It must not know
// how a pass gathers. Papers: Hachisuka & Jensen 2009; Knaus & Zwicker 2011; Doidge et al. 2012.
#pragma once

#include "integrator/estimator/estimator.h"
#include "integrator/learning/photon_guiding.h"
#include "route/scene_symbols.h"

namespace nephroid {

class PhotonMapping : public Estimator {
 public:
  PhotonMapping(OwnedRoutes owned, const IntegratorOptions& options);

  Capabilities capabilities() const override { return {}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override;

 private:
  LearnedPhotons learned_;
  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool photons_can_count_;
  uint64_t found_ = 0;  ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
