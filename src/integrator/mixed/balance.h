// How the work of a pass is allocated: camera paths over the picture, camera paths against light
// paths, and which techniques are worth their time. Decided once, from the variance of a few trial
// passes and from counts of what they cost, never from a clock (docs/estimators.md, section 21).
// It must not know how passes are rendered.
#pragma once

#include "integrator/estimator/sample_map.h"

namespace nephroid {

struct SampleAllocation {
  SampleMap paths;   ///< camera paths
  SampleMap chains;  ///< walks for specular chains; 0: camera paths find these
  static void members(auto& self, auto& archive) { archive(self.paths, self.chains); }
};

/// What the samples of one pass say of all later ones, by tile. The brightness that variances are
/// taken over is of all light.
struct TileStatistics {
  SampleVariance::ByTile paths;   ///< camera paths, specular chains left out
  SampleVariance::ByTile chains;  ///< walks for specular chains; empty where there are none
  SampleVariance::ByTile choice;  ///< chains if camera paths find them; costs nothing more
};

/// [A2] Allocates samples so that the error falls fastest: walks of either kind as the root of
/// variance over cost, and each tile in the cheaper of both ways. `max_mean` camera paths a pixel
/// in the mean at most, 1 or more.
SampleAllocation allocate_samples(const PixelBounds& bounds, int spacing,
                                  const TileStatistics& tiles,
                                  double max_mean = SampleMap::kMaxMean);

/// What trial passes over a lattice of pixels told, as if the lattice were the film.
struct Trial {
  double variance_of_camera = 0;  ///< of one camera path, given the photons
  double variance_of_light = 0;   ///< of a pass, by its photons
  double cost_of_camera = 0;      ///< of one camera path for each pixel
  double cost_of_light = 0;       ///< of all light paths of a pass, and of merging their photons
  double light_paths = 0;         ///< of one pass
  double light = 0;               ///< mean of the picture
  double error = 0;               ///< standard error of that mean
  double samples = 0;             ///< camera paths that it is a mean of
  double records = 0;             ///< that a camera path leaves in the mean
  double photons = 0;             ///< that a light path leaves in the mean
  /// [A4] The least variance that light can have which another trial has seen and this one has not.
  double min_variance_of_unseen(const Trial& other) const;
};

/// The mean of some tiles without the few that stand out: what one lucky path did says little.
double winsorized_mean(std::vector<double> tiles);

/// Light paths of a pass.
inline constexpr double kMinLightPaths = 1 << 10, kMaxLightPaths = 1 << 22;

/// [A3] The number of light paths with which a pass of `camera_paths` for each pixel has the least
/// variance times cost, and that of one camera path.
struct Balance {
  double max_photons = 1 << 18;  ///< that a pass keeps, about
  double min_light_paths = 0;    ///< unless they leave more photons than that
  double scale = 1;              ///< pixels of the film over those of the lattice
  double variance_of_camera = 0, variance_of_light = 0, cost_of_camera = 0, cost_of_light = 0;
  double photons_of_path = 0;  ///< that one light path leaves
  explicit Balance(const Trial& trial);
  /// To be read into.
  Balance() = default;
  static void members(auto& self, auto& archive) {
    archive(self.max_photons, self.min_light_paths, self.scale, self.variance_of_camera,
            self.variance_of_light, self.cost_of_camera, self.cost_of_light, self.photons_of_path);
  }
  bool is_sound() const;
  /// The best number between min_light_paths and what leaves max_photons.
  int64_t light_paths(double camera_paths) const;
  /// Camera paths of each pixel beside which the best number of light paths is not too many.
  double max_camera_paths() const { return max_light_paths() / light_paths_of_camera_path(); }
  double inverse_efficiency() const;

 private:
  double max_light_paths() const;
  double light_paths_of_camera_path() const;
};

}  // namespace nephroid
