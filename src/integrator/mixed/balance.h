// How the work of a pass is shared out: camera paths over the picture, camera paths against light
// paths, and which techniques are worth their time. Decided once, from the spread of a few trial
// passes and from counts of what they cost, never from a clock, so that every pass of a render,
// wherever it is rendered, is shared out alike (docs/estimators.md, section 21). Who calls it:
// path+photons. It must not know how passes are rendered.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "film/film.h"

namespace nephroid {

/// Walks of one kind from each pixel in a pass, the same for all pixels of a tile.
class SampleMap {
 public:
  static constexpr int kTile = 4, kMost = 8, kMostGlints = 32;
  static constexpr double kMostMean = 2.5;  ///< of maps that are shared out

  /// The same number for each pixel.
  explicit SampleMap(const PixelBounds& b, uint16_t samples = 1)
      : width_((b.width() + kTile - 1) / kTile),
        counts_(static_cast<size_t>(width_) * static_cast<size_t>((b.height() + kTile - 1) / kTile),
                samples) {}

  /// `x` and `y` count from the corner of the crop.
  int at(int x, int y) const { return counts_[tile_of(x, y)]; }
  int most() const;
  int fewest() const;
  bool has(int samples) const;  ///< some tile has this number
  double mean() const;
  size_t tile_of(int x, int y) const {
    return static_cast<size_t>(y / kTile) * static_cast<size_t>(width_) +
           static_cast<size_t>(x / kTile);
  }
  int width() const { return width_; }
  std::vector<uint16_t>& counts() { return counts_; }
  const std::vector<uint16_t>& counts() const { return counts_; }

 private:
  int width_;
  std::vector<uint16_t> counts_;  ///< [tile]
};

/// What several samples of each pixel found; each pixel has one writer at a time.
class SampleSpread {
  struct Sums {
    double light = 0, square = 0, rays = 0;
    int samples = 0;
  };

 public:
  static constexpr size_t kBytesPerPixel = sizeof(Sums);

  explicit SampleSpread(const PixelBounds& b) : bounds_(b), sums_(static_cast<size_t>(b.area())) {}
  /// One sample that took `rays`; `pixel` counts row by row over the crop.
  void add(size_t pixel, double luminance, double rays) {
    add(pixel, luminance, rays, luminance * luminance);
  }
  /// The same for samples whose mean square is known better.
  void add(size_t pixel, double luminance, double rays, double square) {
    Sums& s = sums_[pixel];
    s.rays += rays;
    s.light += luminance;
    s.square += square;
    ++s.samples;
  }
  /// Zero where no pixel has two samples.
  struct ByTile {
    std::vector<double> variance;  ///< [tile] of a sample, over the brightness, [A1]
    std::vector<double> light;     ///< [tile] mean magnitude
    std::vector<double> cost;      ///< [tile] of a sample, in rays
  };
  /// What is `beside` these samples in the same pixels counts as brightness of the tiles, too.
  ByTile by_tile(const SampleSpread* beside = nullptr) const;

 private:
  PixelBounds bounds_;
  std::vector<Sums> sums_;
};

struct Shares {
  SampleMap paths;   ///< camera paths
  SampleMap glints;  ///< walks that look for lights behind delta lobes; 0: camera paths find these
};

/// What the samples of one pass say of all later ones, by tile. The brightness that variances are
/// taken over is of all light.
struct Spreads {
  SampleSpread::ByTile paths;   ///< of camera paths, what glints find left out
  SampleSpread::ByTile glints;  ///< empty, as `choice`, where there is no such light
  SampleSpread::ByTile choice;  ///< of glints if camera paths find them; costs nothing more
};

/// [A2] Shares the work out so that the error falls fastest: walks of either kind as the root of
/// variance over cost, and each tile in the cheaper of both ways; or all glints by walks of their
/// own. `most_mean` camera paths a pixel in the mean at most, 1 or more.
Shares share_out(const PixelBounds& bounds, const Spreads& spreads, bool glints_apart = false,
                 double most_mean = SampleMap::kMostMean);

/// What trial passes told.
struct Trial {
  double variance = 0;        ///< of one pass
  double cost_of_camera = 0;  ///< of the camera paths of one pass
  double cost_of_light = 0;   ///< of all its light paths
  double light_paths = 0;     ///< of one pass
  double light = 0;           ///< mean of the picture
  double error = 0;           ///< standard error of that mean
  double samples = 0;         ///< camera paths that it is a mean of
  double records = 0;         ///< that a camera path leaves in the mean
  double photons = 0;         ///< that a light path leaves in the mean
  /// [A4] The least variance that light can have which another trial has seen and this one has not.
  double least_of_unseen(const Trial& other) const;
  double expense() const { return variance * (cost_of_camera + cost_of_light); }
};

/// The mean of some tiles without the few that stand out: what one lucky path did says little.
double steady_mean(std::vector<double> tiles);

/// [A3] The number of light paths with which a pass of `camera_paths` for each pixel has the least
/// variance times cost, and that of one camera path; from a trial with many light paths and one
/// with few.
struct Balance {
  static constexpr double kMostPhotons = 1 << 18;  ///< that a pass keeps, about
  double variance_of_camera = 0, variance_of_light = 0, cost_of_camera = 0, cost_of_light = 0;
  double photons_of_path = 0;  ///< that one light path leaves
  Balance(const Trial& many, const Trial& few);
  /// Of a pass without light paths.
  explicit Balance(const Trial& trial)
      : variance_of_camera(trial.variance), cost_of_camera(trial.cost_of_camera) {}
  /// The best number, as far as it leaves no more than kMostPhotons.
  int64_t light_paths(double camera_paths) const;
  /// Camera paths of each pixel beside which the best number of light paths is not too many.
  double most_camera_paths() const { return most_light_paths() / light_paths_of_camera_path(); }
  double expense() const;
  /// That of the same light paths beside the camera paths of another trial.
  Balance with_camera_paths_of(const Trial& trial) const;

 private:
  void take_camera_paths(const Trial& trial);
  double most_light_paths() const;
  double light_paths_of_camera_path() const;
};

}  // namespace nephroid
