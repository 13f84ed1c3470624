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
  /// `most` samples of a pixel at most.
  MeasuredSamples(const FilmFormat& film, size_t most)
      : film_(film), samples_(film.bounds().area() * most), most_(most) {}

  /// Sample number pixel * most + k. Light adds up over batches; rays are those of the first one.
  void add_light(size_t sample, float light) { samples_[sample].light += light; }
  void set_rays(size_t sample, uint64_t rays) { samples_[sample].rays = static_cast<float>(rays); }
  void scale_light(size_t sample, float factor) { samples_[sample].light *= factor; }
  /// Splats of `light_paths` light paths, as light of all samples of the nearest pixel.
  void add_splats(std::span<const Splat> splats, float light_paths);

  /// Adds the samples of which each pixel of the first lattice has as many as `map` says.
  void add_to(SampleVariance& variance, const SampleMap& map) const;

 private:
  const FilmFormat& film_;
  std::vector<Sample> samples_;  ///< [pixel * most + sample]
  size_t most_;
  std::vector<float> splatted_;  ///< [pixel] mean of the components; empty without splats
};

}  // namespace nephroid
