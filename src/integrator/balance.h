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

/// Camera paths of each pixel in a pass, the same for all pixels of a tile.
class SampleMap {
 public:
  static constexpr int kTile = 4, kMost = 8;

  /// The same number of paths for each pixel.
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
    Sums& s = sums_[pixel];
    s.rays += rays;
    s.light += luminance;
    s.square += luminance * luminance;
    ++s.samples;
  }
  /// Zero where no pixel has two samples.
  struct ByTile {
    std::vector<double> variance;  ///< [tile] of a sample, over the brightness, [A1]
    std::vector<double> cost;      ///< [tile] of a sample, in rays
  };
  ByTile by_tile() const;

 private:
  PixelBounds bounds_;
  std::vector<Sums> sums_;
};

/// [A2] Shares camera paths out so that the error falls fastest: as the root of variance over cost.
SampleMap share_out(const PixelBounds& bounds, const SampleSpread::ByTile& spread);

/// What trial passes told.
struct Trial {
  double variance = 0;     ///< of one pass
  double cost = 0;         ///< of one pass
  double light_paths = 0;  ///< of one pass
  double expense() const { return variance * cost; }
};

/// The mean of some tiles without the few that stand out: what one lucky path did says little.
double steady_mean(std::vector<double> tiles);

/// [A3] The number of light paths with which a pass of `camera_paths` for each pixel has the least
/// variance times cost, and that of one camera path; from a trial with many light paths and one
/// with few.
struct Balance {
  double variance_of_camera = 0, variance_of_light = 0, cost_of_camera = 0, cost_of_light = 0;
  Balance(const Trial& many, const Trial& few);
  int64_t light_paths(double camera_paths) const;
  double expense() const;
};

}  // namespace nephroid
