// The light of each camera path of a pass, kept until all batches of photons are merged, to measure
// how much samples vary. It must not know how paths are made.
#pragma once

#include <span>
#include <vector>

#include "film/splats.h"
#include "integrator/estimator/sample_map.h"

namespace nephroid {

class MeasuredSamples {
 public:
  struct Sample {
    float light = 0, rays = 0;
  };
  /// Of the pixels of the first lattice of a film, `most` samples of each at most.
  MeasuredSamples(const FilmFormat& film, size_t most);

  /// The number of sample `k` of a pixel of the lattice.
  size_t sample(int x, int y, int k) const { return pixel_of(x, y) * most_ + k; }
  /// Light adds up over batches; rays are those of the first one.
  void add_light(size_t sample, float light) { samples_[sample].light += light; }
  void set_rays(size_t sample, uint64_t rays) { samples_[sample].rays = static_cast<float>(rays); }
  void scale_light(size_t sample, float factor) { samples_[sample].light *= factor; }
  /// Splats of `light_paths` light paths, as light of all samples of the lattice's pixel in whose
  /// place they fall.
  void add_splats(std::span<const Splat> splats, float light_paths);

  /// Adds the samples of which each pixel has as many as `map` says.
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
  std::vector<float> splatted_;  ///< [pixel] mean of the components; empty without splats
};

}  // namespace nephroid
