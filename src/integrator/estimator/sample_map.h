// How many samples each part of the picture has, and how much samples vary there. It must not know
// how samples are made or why they are allocated as they are.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film_format.h"

namespace nephroid {

/// How many walks of one kind each pixel has in a pass, the same for all pixels of a tile. Tiles
/// are as large as makes them hold some pixels of the lattice that is learned from.
class SampleMap {
 public:
  static constexpr int kTile = 4;  ///< pixels of the lattice across a tile
  static constexpr int kMax = 8, kMaxChainWalks = 32;
  static constexpr double kMaxMean = 2.5;  ///< of maps that are shared out

  /// To be read into.
  SampleMap() = default;
  /// The same number for each pixel; `spacing` is that of the lattice.
  explicit SampleMap(const PixelBounds& b, uint16_t samples = 1, int spacing = 1)
      : tile_(kTile * spacing),
        width_((b.width() + tile_ - 1) / tile_),
        counts_(static_cast<size_t>(width_) * ((b.height() + tile_ - 1) / tile_), samples) {}

  /// `x` and `y` count from the corner of the crop.
  int at(int x, int y) const { return counts_[tile_of(x, y)]; }
  int most() const;
  int fewest() const;
  bool has(int samples) const;  ///< some tile has this number
  double mean() const;
  size_t tile_of(int x, int y) const { return static_cast<size_t>(y / tile_) * width_ + x / tile_; }
  int width() const { return width_; }
  static void members(auto& self, auto& archive) { archive(self.tile_, self.width_, self.counts_); }
  /// Has the tiles of a film, those of a lattice of that spacing or of all pixels, and `min` to
  /// `max` in each.
  bool is_sound(const PixelBounds& b, int spacing, int min, int max) const;
  std::vector<uint16_t>& counts() { return counts_; }
  const std::vector<uint16_t>& counts() const { return counts_; }

 private:
  bool has_tiles_of(const SampleMap& other) const;

  int tile_ = kTile;  ///< pixels across
  int width_ = 0;
  std::vector<uint16_t> counts_;  ///< [tile]
};

/// What several samples of each pixel of a lattice found; each pixel has one writer at a time.
class SampleVariance {
  struct Sums {
    double light = 0, square = 0, rays = 0;
    int samples = 0;
  };

 public:
  static constexpr size_t kBytesPerPixel = sizeof(Sums);  ///< of the lattice

  explicit SampleVariance(const PixelBounds& b, int spacing = 1)
      : bounds_(b),
        spacing_(spacing),
        width_((b.width() + spacing - 1) / spacing),
        sums_(static_cast<size_t>(width_) * ((b.height() + spacing - 1) / spacing)) {}
  /// One sample that took `rays`, of a pixel of the lattice, counted from the corner of the crop.
  void add(int x, int y, double luminance, double rays) {
    add(x, y, luminance, rays, luminance * luminance);
  }
  /// The same for samples whose mean square is known better.
  void add(int x, int y, double luminance, double rays, double square) {
    Sums& s = sums_[static_cast<size_t>(y / spacing_) * width_ + x / spacing_];
    s.rays += rays;
    s.light += luminance;
    s.square += square;
    ++s.samples;
  }
  /// The samples of another one of the same lattice count, too.
  void add(const SampleVariance& other);
  /// Zero where no pixel has two samples.
  struct ByTile {
    std::vector<double> variance;    ///< [tile] of a sample, over the brightness, [A1]
    std::vector<double> brightness;  ///< [tile] that it is over
    std::vector<double> light;       ///< [tile] mean magnitude
    std::vector<double> cost;        ///< [tile] of a sample, in rays
  };
  /// The light of `others`, in the same pixels, counts as brightness of the tiles, too.
  ByTile by_tile(const SampleVariance* others = nullptr) const;

 private:
  PixelBounds bounds_;
  int spacing_, width_;
  std::vector<Sums> sums_;  ///< [pixel of the lattice]
};

}  // namespace nephroid
