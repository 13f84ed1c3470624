// `ppm`: progressive photon mapping, `sppm` whose camera walks stay. Each pixel has K hit points,
// and each of them its own radius, count and flux: memory grows with anti-aliasing. A hit point is
// walked to again in each pass by the same random numbers, with the wavelengths, time and roughness
// threshold of the pass (ADR 17). It must not know how a pass gathers. Paper: Hachisuka, Ogaki &
// Jensen 2008.
#pragma once

#include "integrator/photon_mapping/sppm.h"

namespace nephroid {

struct PpmOptions {
  int hit_points = 0;  ///< per pixel; 0: as many as samples, within 4 to 16
};

class Ppm : public Sppm {
 public:
  using Sppm::Sppm;
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  EstimatorStatistics statistics() const override;

  /// K: the user's, or the scene's samples per pixel, but at least 4 and at most 16.
  static int hit_points(const IntegratorOptions& options, int samples_per_pixel);

 private:
  int regions_per_pixel(const Scene& scene) const override;
  std::span<const SobolPoint> points(const PhotonPass& pass, const Scene& scene) override;

  std::vector<SobolPoint> points_;  ///< the same in all passes
};

}  // namespace nephroid
