// `ppm`: progressive photon mapping, `sppm` with K fixed hit points per pixel, each with its own
// radius, count and flux [N3]. Each pass walks to a hit point again by the same random numbers,
// with the pass's wavelengths, time and roughness threshold (ADR 17). It must not know how a pass
// gathers. Paper: Hachisuka, Ogaki & Jensen 2008.
#pragma once

#include "integrator/photon_mapping/sppm.h"

namespace nephroid {

struct PpmOptions {
  int hit_points = 0;  ///< hit points per pixel; 0: the scene's samples per pixel, from 4 to 16
};

class Ppm : public Sppm {
 public:
  using Sppm::Sppm;
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  EstimatorStatistics statistics() const override;

  /// K: the user's, or the scene's samples per pixel, clamped to 4 to 16.
  static int hit_points(const IntegratorOptions& options, int samples_per_pixel);

 private:
  int regions_per_pixel(const Scene& scene) const override;
  std::span<const SobolPoint> points(const PhotonPass& pass, const Scene& scene) override;

  std::vector<SobolPoint> points_;  ///< [hit point], the same in all passes
};

}  // namespace nephroid
