// Light and cost of each camera path of a pass, kept until all batches of photons are merged, to
// measure the variance of samples. It must not know how paths are made.
#pragma once

#include <vector>

#include "integrator/estimator/sample_map.h"

namespace nephroid {

class MeasuredSamples {
 public:
  struct Sample {
    float light = 0, cost = 0, photon_squares = 0;
  };
  /// Room for at most `most` samples of each pixel of the film's first lattice.
  MeasuredSamples(const FilmFormat& film, size_t most);

  /// Index of sample `k` of a pixel of the lattice.
  size_t sample(int x, int y, int k) const { return pixel_of(x, y) * most_ + k; }
  /// Light, the squares of SampleVariance::add_photons, and cost add up over batches.
  void add_light(size_t sample, float light, float photon_squares) {
    samples_[sample].light += light;
    samples_[sample].photon_squares += photon_squares;
  }
  void add_cost(size_t sample, double rays) { samples_[sample].cost += static_cast<float>(rays); }
  void scale_light(size_t sample, float factor) {
    samples_[sample].light *= factor;
    samples_[sample].photon_squares *= factor * factor;
  }

  /// Adds all samples; `map` gives their number per pixel.
  void add_to(SampleVariance& variance, const SampleMap& map) const;

 private:
  size_t pixel_of(int x, int y) const {
    const PixelBounds& b = film_.bounds();
    return static_cast<size_t>((y - b.y0) / spacing_) * width_ + (x - b.x0) / spacing_;
  }

  const FilmFormat& film_;
  int spacing_, width_;
  std::vector<Sample> samples_;  ///< [pixel * most + sample]
  size_t most_;
};

}  // namespace nephroid
