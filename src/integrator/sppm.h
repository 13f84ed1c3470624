// `sppm`: stochastic progressive photon mapping as published [E1]. Photons render all light that
// reaches a D vertex, direct light too; light seen directly or through S lobes is averaged.
// Per pixel it keeps a radius, a photon count and flux, so its passes are a sequence.
// Paper: Hachisuka & Jensen 2009.
#pragma once

#include "integrator/estimator.h"
#include "photon/radius_schedule.h"
#include "route/routes.h"

namespace nephroid {

class Sppm : public Estimator {
 public:
  /// Seen emission goes to buffer `emission_buffer`, everything else to `photon_buffer`.
  Sppm(int emission_buffer, int photon_buffer, const IntegratorOptions& options);

  Capabilities capabilities() const override {
    return {.independent_passes = false, .per_pixel_state = true};
  }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  Routes routes_;
  int emission_buffer_, photon_buffer_;
  IntegratorOptions options_;
  std::vector<SharedStatistics> pixels_;
  std::vector<float> footprint_;  ///< of the first visible point, world units, for the report
  double emitted_ = 0;            ///< sum of N_i
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
