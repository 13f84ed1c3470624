// How many samples each part of the picture has, and how much samples vary there. It must not know
// how samples are made or why they are allocated as they are.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film_format.h"

namespace nephroid {

/// How many walks of one kind each pixel has in a pass, the same for all pixels of a tile.
class SampleMap {
 public:
  static constexpr int kTile = 4, kMax = 8, kMaxChainWalks = 32;
  static constexpr double kMaxMean = 2.5;  ///< of maps that are shared out

  /// To be read into.
  SampleMap() = default;
  /// The same number for each pixel.
  explicit SampleMap(const PixelBounds& b, uint16_t samples = 1)
      : width_((b.width() + kTile - 1) / kTile),
        counts_(static_cast<size_t>(width_) * ((b.height() + kTile - 1) / kTile), samples) {}

  /// `x` and `y` count from the corner of the crop.
  int at(int x, int y) const { return counts_[tile_of(x, y)]; }
  int most() const;
  int fewest() const;
  bool has(int samples) const;  ///< some tile has this number
  double mean() const;
  size_t tile_of(int x, int y) const { return static_cast<size_t>(y / kTile) * width_ + x / kTile; }
  int width() const { return width_; }
  static void members(auto& self, auto& archive) { archive(self.width_, self.counts_); }
  std::vector<uint16_t>& counts() { return counts_; }
  const std::vector<uint16_t>& counts() const { return counts_; }

 private:
  int width_ = 0;
  std::vector<uint16_t> counts_;  ///< [tile]
};

/// What several samples of each pixel found; each pixel has one writer at a time.
class SampleVariance {
  struct Sums {
    double light = 0, square = 0, rays = 0;
    int samples = 0;
  };

 public:
  static constexpr size_t kBytesPerPixel = sizeof(Sums);

  explicit SampleVariance(const PixelBounds& b) : bounds_(b), sums_(b.area()) {}
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
  /// The light of `others`, in the same pixels, counts as brightness of the tiles, too.
  ByTile by_tile(const SampleVariance* others = nullptr) const;

 private:
  PixelBounds bounds_;
  std::vector<Sums> sums_;
};

}  // namespace nephroid
