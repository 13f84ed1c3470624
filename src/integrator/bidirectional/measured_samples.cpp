#include "integrator/bidirectional/measured_samples.h"

#include <cmath>

namespace nephroid {

void MeasuredSamples::add_splats(std::span<const Splat> splats, float light_paths) {
  const PixelBounds& b = film_.bounds();
  splatted_.resize(static_cast<size_t>(b.area()));
  for (const Splat& splat : splats) {
    const int x = static_cast<int>(std::floor(splat.film.x)) - b.x0,
              y = static_cast<int>(std::floor(splat.film.y)) - b.y0;
    if (x < 0 || y < 0 || x >= b.width() || y >= b.height()) continue;
    const float sum = splat.value.r + splat.value.g + splat.value.b;
    splatted_[static_cast<size_t>(y) * static_cast<size_t>(b.width()) + static_cast<size_t>(x)] +=
        sum / 3.0f / light_paths;
  }
}

void MeasuredSamples::add_to(SampleVariance& variance, const SampleMap& map) const {
  const PixelBounds& b = film_.bounds();
  size_t pixel = 0;
  for (int y = 0; y < b.height(); ++y)
    for (int x = 0; x < b.width(); ++x, ++pixel)
      for (size_t k = 0; k < static_cast<size_t>(map.at(x, y)); ++k) {
        const Sample& sample = samples_[pixel * most_ + k];
        variance.add(pixel,
                     static_cast<double>(sample.light) +
                         (splatted_.empty() ? 0.0 : static_cast<double>(splatted_[pixel])),
                     static_cast<double>(sample.rays));
      }
}

}  // namespace nephroid
