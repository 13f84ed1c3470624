// The photons of `sppm`: stochastic progressive photon mapping as published [E1]. They render all
// light that reaches a D vertex, direct light too; C S* L, light seen directly or through S lobes,
// is the path estimator's. Per pixel it keeps a radius, a photon count and flux, so its passes are
// a sequence. Paper: Hachisuka & Jensen 2009.
#pragma once

#include "integrator/estimator.h"
#include "photon/radius_schedule.h"
#include "route/routes.h"

namespace nephroid {

class Sppm : public Estimator {
 public:
  /// Renders into the film's buffer `photon_buffer`.
  Sppm(int photon_buffer, const IntegratorOptions& options);

  Capabilities capabilities() const override {
    return {.independent_passes = false, .per_pixel_state = true};
  }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override;

 private:
  Routes routes_;
  int photon_buffer_;
  IntegratorOptions options_;
  std::vector<SharedStatistics> pixels_;
  std::vector<float> footprint_;  ///< of the first visible point, world units, for the report
  double emitted_ = 0;            ///< sum of N_i
  uint64_t found_ = 0;            ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
