// `sppm`: stochastic progressive photon mapping as published [E1], for the photons of its own
// routes. The region of each camera walk keeps a radius, a photon count and the flux of each part,
// so passes are sequential. Papers: Hachisuka & Jensen 2009; Hachisuka, Ogaki & Jensen 2008.
#pragma once

#include <array>
#include <span>

#include "integrator/estimator/estimator.h"
#include "photon/radius_schedule.h"
#include "route/scene_symbols.h"

namespace nephroid {

struct PhotonPass;

class Sppm : public Estimator {
 public:
  Sppm(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;
  void add_state(const Scene& scene, const Film& film, RenderState& state) override;

  /// The text of EstimatorDescriptor::outlier_warning.
  static constexpr const char* kNoEstimatesToHold =
      "keep theirs, they have no estimates that could be held";
  /// First radius of all regions, in footprints, for a picture of so many pixels: the user's, or
  /// the default.
  static float first_radius(const IntegratorOptions& options, int64_t pixels);
  /// For EstimatorDescriptor::exposed_pixels.
  static float pixels_of_first_radius(const IntegratorOptions& options, const PixelFilter&,
                                      int64_t pixels);

  /// Bytes per region kept from pass to pass, and bytes per region that a pass needs beside them.
  static constexpr size_t bytes_kept(size_t parts) {
    return sizeof(SharedStatistics) + parts * sizeof(std::array<double, 3>) + sizeof(float);
  }
  static size_t bytes_of_pass(size_t parts);

 protected:
  /// Number of regions of a pixel. Walk k gathers for region k.
  virtual int regions_per_pixel(const Scene&) const { return 1; }
  /// Random numbers of the walks of a pass, one Sobol' point per region of a pixel.
  virtual std::span<const SobolPoint> points(const PhotonPass& pass, const Scene& scene);

  const OwnedRoutes owned_;
  IntegratorOptions options_;

 private:
  void start_regions(const Scene& scene, size_t pixels, size_t parts);
  /// Applies [E1] to every region and updates the film.
  void update(struct Gathered& gathered, std::span<const uint64_t> counts, Film& film,
              double photons);

  size_t regions_in_pixel_ = 1;
  std::vector<SharedStatistics> regions_;    ///< [pixel * regions of a pixel + k]
  std::vector<std::array<double, 3>> flux_;  ///< τ of [E1] as RGB, [region * parts + part]
  std::vector<float>
      footprint_;  ///< footprint of the first visible point, world units; for reports
  struct Totals {
    double emitted = 0;  ///< Σ N_i
    uint64_t found = 0;  ///< photons merged
  };
  Totals totals_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
