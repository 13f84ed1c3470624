// Allocation of a pass's work: camera paths over the picture, camera paths against light paths, and
// the efficiency of techniques. It is decided once, from variance and ray counts of trial passes
// and of a measured pass, never from a clock (docs/estimators.md, section 21). It must not know how
// passes are rendered.
#pragma once

#include "integrator/estimator/sample_map.h"

namespace nephroid {

struct SampleAllocation {
  SampleMap paths;   ///< camera paths per pixel
  SampleMap chains;  ///< walks for specular chains per pixel; 0: camera paths find these
  static void members(auto& self, auto& archive) { archive(self.paths, self.chains); }
};

/// Variance and cost of samples by tile, measured in one pass for all later ones. Variances are
/// divided by the brightness of all light.
struct TileStatistics {
  SampleVariance::ByTile paths;   ///< camera paths without specular chains
  SampleVariance::ByTile chains;  ///< walks for specular chains; empty if there are none
  SampleVariance::ByTile choice;  ///< chains found by camera paths, at no extra cost
};

/// Upper limits of the mean number per pixel and pass.
struct MeanLimits {
  double paths = SampleMap::kMaxMean;  ///< camera paths; at least 1
  double walks = kInfinity;            ///< camera paths and walks for chains; at least 2
};
/// The limits in a film, or a crop of one, with so many pixels. They are lower in a large one,
/// whose first whole picture would come late (ADR 29).
MeanLimits limits_of_film(int64_t pixels);

/// [A2], [S2] Allocates samples for the fastest fall of the error: walks of either kind in
/// proportion to sqrt(typical variance / cost), and each tile in the cheaper of both ways.
/// `spacing` is the distance of the measured pixels, in pixels of the film.
SampleAllocation allocate_samples(const PixelBounds& bounds, int spacing,
                                  const TileStatistics& tiles, const MeanLimits& limits = {});

/// The noise and the work of a pass by tile, to choose its number of light paths.
struct PassNoise {
  struct Tile {
    double camera;   ///< typical variance of its camera paths and walks
    double photons;  ///< upper bound of the variance due to photons, times light paths
  };
  std::vector<Tile> tiles;
  double camera_paths = 0;  ///< mean number of camera paths per pixel
  double walk_rays = 0;     ///< mean rays of walks for specular chains per pixel of `tiles`
  /// For passes of these samples. `measured_light_paths` is the number in the film that
  /// corresponds to the pass in which the tiles were measured.
  PassNoise(const TileStatistics& tiles, const SampleAllocation& samples,
            double measured_light_paths);
};

/// Results of trial passes over a lattice of pixels, as if the lattice were the film.
struct Trial {
  double variance_of_camera = 0;  ///< variance of one camera path, given the photons
  double variance_of_light = 0;   ///< variance of a pass due to its photons
  double cost_of_camera = 0;      ///< rays of one camera path per pixel
  double cost_of_light = 0;       ///< rays of a pass's light paths, merging of photons included
  double light_paths = 0;         ///< light paths per pass
  double light = 0;               ///< mean of the picture
  double error = 0;               ///< standard error of that mean
  double samples = 0;             ///< camera paths in that mean
  double records = 0;             ///< mean number of records per camera path
  double photons = 0;             ///< mean number of photons per light path
  double cost_of_merging = 0;     ///< the part of cost_of_light that grows with camera paths
  double pixels = 0;              ///< pixels of the lattice
  /// [A4] Lower bound of the variance of light that `other` has seen and this trial has not.
  double min_variance_of_unseen(const Trial& other) const;
};

/// The mean of tiles; values above the 99.5th percentile count as that, as one lucky path says
/// little.
double winsorized_mean(std::vector<double> tiles);

/// Bounds of the number of light paths per pass.
inline constexpr double kMinLightPaths = 1 << 10, kMaxLightPaths = 1 << 22;

/// [A3] The number of light paths that minimizes variance times cost of a pass.
struct Balance {
  double max_photons = 1 << 18;  ///< approximate limit of photons kept by a pass
  double min_light_paths = 0;    ///< lower bound, unless they leave more than max_photons
  double scale = 1;              ///< pixels of the film over those of the lattice
  double variance_of_camera = 0, variance_of_light = 0, cost_of_camera = 0, cost_of_light = 0;
  double cost_of_merging = 0;  ///< the part of cost_of_light that grows with camera paths
  double pixels = 0;           ///< pixels of the lattice
  double photons_of_path = 0;  ///< mean number of photons per light path
  explicit Balance(const Trial& trial);
  /// Best number of light paths for `camera_paths` per pixel, from min_light_paths to max_photons.
  int64_t light_paths(double camera_paths) const;
  /// [A8] Best number for passes whose noise is known by tile, at least that of [A3].
  int64_t light_paths(const PassNoise& pass) const;
  /// [A7] For photons of all light: they lower v, too, so that more of them are best. Raises
  /// min_light_paths to the best number for one camera path per pixel.
  void let_photons_lower_variance_of_camera(const Trial& trial);
  /// Camera paths per pixel at which the best number of light paths reaches its limit.
  double max_camera_paths() const { return max_light_paths() / light_paths_of_camera_path(); }
  double inverse_efficiency() const;

 private:
  double max_light_paths() const;
  double light_paths_of_camera_path() const;
};

}  // namespace nephroid
