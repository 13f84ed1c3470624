// Number and variance of samples in each tile of the picture. It must not know how samples are made
// or why they are allocated as they are.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film_format.h"

namespace nephroid {

/// Number of walks of one kind per pixel and pass, the same for all pixels of a tile. A tile is
/// kTile pixels wide on the lattice that is learned from.
class SampleMap {
 public:
  static constexpr int kTile = 4;  ///< pixels of the lattice across a tile
  static constexpr int kMax = 8, kMaxChainWalks = 32;
  static constexpr double kMaxMean = 2.5;  ///< largest limit of a map's mean

  /// A value to be read into.
  SampleMap() = default;
  /// The same number for each pixel; `spacing` is the lattice's.
  explicit SampleMap(const PixelBounds& b, uint16_t samples = 1, int spacing = 1)
      : tile_(kTile * spacing),
        width_((b.width() + tile_ - 1) / tile_),
        counts_(static_cast<size_t>(width_) * ((b.height() + tile_ - 1) / tile_), samples) {}

  /// `x` and `y` count from the corner of the crop.
  int at(int x, int y) const { return counts_[tile_of(x, y)]; }
  int most() const;
  int fewest() const;
  bool has(int samples) const;  ///< whether some tile has this number
  double mean() const;
  size_t tile_of(int x, int y) const { return static_cast<size_t>(y / tile_) * width_ + x / tile_; }
  int width() const { return width_; }
  static void members(auto& self, auto& archive) { archive(self.tile_, self.width_, self.counts_); }
  /// True if the tiles fit the film, for a lattice of that spacing or of all pixels, and each count
  /// is in [min, max].
  bool is_sound(const PixelBounds& b, int spacing, int min, int max) const;
  std::vector<uint16_t>& counts() { return counts_; }
  const std::vector<uint16_t>& counts() const { return counts_; }

 private:
  bool has_tiles_of(const SampleMap& other) const;

  int tile_ = kTile;  ///< pixels across a tile
  int width_ = 0;
  std::vector<uint16_t> counts_;  ///< [tile]
};

/// Variance among the samples of each pixel of a lattice; each pixel has one writer at a time.
class SampleVariance {
  struct Sums {
    double light = 0, square = 0, photons = 0, rays = 0;
    int samples = 0;
  };

 public:
  static constexpr size_t kBytesPerPixel = sizeof(Sums);  ///< bytes per pixel of the lattice

  explicit SampleVariance(const PixelBounds& b, int spacing = 1)
      : bounds_(b),
        spacing_(spacing),
        width_((b.width() + spacing - 1) / spacing),
        sums_(static_cast<size_t>(width_) * ((b.height() + spacing - 1) / spacing)) {}
  /// Adds a sample that took `rays` at a pixel of the lattice, counted from the crop's corner.
  void add(int x, int y, double luminance, double rays) {
    add(x, y, luminance, rays, luminance * luminance);
  }
  /// The same for samples with a better estimate of their square.
  void add(int x, int y, double luminance, double rays, double square) {
    Sums& s = sums_[static_cast<size_t>(y / spacing_) * width_ + x / spacing_];
    s.rays += rays;
    s.light += luminance;
    s.square += square;
    ++s.samples;
  }
  /// Adds the sum of squares of a sample's light from merged photons, one by one: the variance of
  /// that light due to the photons, which arrive independently of each other ([A6]).
  void add_photons(int x, int y, double squares) {
    sums_[static_cast<size_t>(y / spacing_) * width_ + x / spacing_].photons += squares;
  }
  /// Adds the samples of another object on the same lattice.
  void add(const SampleVariance& other);
  /// Means per tile; zero where no pixel has two samples.
  struct ByTile {
    std::vector<double> variance;  ///< [tile] variance of a sample over `brightness`, [A1]
    /// [tile] σ² of [A1], the square of the mean standard deviation of its pixels over
    /// `brightness`: a few pixels that are noisier than the others count for less.
    std::vector<double> typical;
    std::vector<double> photons;     ///< [tile] variance due to photons over `brightness`
    std::vector<double> brightness;  ///< [tile] the divisor of `variance`
    std::vector<double> light;       ///< [tile] mean magnitude of the light
    std::vector<double> cost;        ///< [tile] rays per sample
  };
  /// Counts the light of `others` in the same pixels towards the brightness.
  ByTile by_tile(const SampleVariance* others = nullptr) const;

 private:
  PixelBounds bounds_;
  int spacing_, width_;
  std::vector<Sums> sums_;  ///< [pixel of the lattice]
};

}  // namespace nephroid
