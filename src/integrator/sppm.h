// `sppm`: stochastic progressive photon mapping as published [E1], for the photons of its own
// routes. Per pixel it keeps a radius, a photon count and the flux of each part, so its passes are
// a sequence. Paper: Hachisuka & Jensen 2009.
#pragma once

#include <array>

#include "integrator/estimator.h"
#include "photon/radius_schedule.h"
#include "route/scene_symbols.h"

namespace nephroid {

class Sppm : public Estimator {
 public:
  Sppm(OwnedRoutes owned, const IntegratorOptions& options);

  Capabilities capabilities() const override {
    return {.independent_passes = false, .per_pixel_state = true};
  }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override;

  /// Memory of a pixel from pass to pass, and what a pass needs beside it.
  static constexpr size_t bytes_kept(size_t parts) {
    return sizeof(SharedStatistics) + parts * sizeof(std::array<double, 3>) + sizeof(float);
  }
  static constexpr size_t bytes_of_pass(size_t parts) {
    return sizeof(Found) + parts * sizeof(Rgb);
  }

 private:
  /// What a pass finds for a pixel, collected over its batches.
  struct Found {
    float filter_weight = 1;
    uint64_t count = 0;
  };

  OwnedRoutes owned_;
  IntegratorOptions options_;
  std::vector<SharedStatistics> pixels_;
  std::vector<std::array<double, 3>> flux_;  ///< tau, [pixel * parts + part], as rgb
  std::vector<float> footprint_;  ///< of the first visible point, world units, for the report
  double emitted_ = 0;            ///< sum of N_i
  uint64_t found_ = 0;            ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
