#include "integrator/bidirectional/measured_samples.h"

#include <cmath>

namespace nephroid {

void MeasuredSamples::add_splats(std::span<const Splat> splats, float light_paths) {
  const PixelBounds& b = film_.bounds();
  splatted_.resize(b.area());
  for (const Splat& splat : splats) {
    const int x = static_cast<int>(std::floor(splat.film.x)) - b.x0,
              y = static_cast<int>(std::floor(splat.film.y)) - b.y0;
    if (x < 0 || y < 0 || x >= b.width() || y >= b.height()) continue;
    const float sum = splat.value.r + splat.value.g + splat.value.b;
    splatted_[static_cast<size_t>(y) * b.width() + x] += sum / 3.0f / light_paths;
  }
}

void MeasuredSamples::add_to(SampleVariance& variance, const SampleMap& map) const {
  const PixelBounds& b = film_.bounds();
  const int spacing = PixelSlices(b).spacing(1);
  for (int y = 0; y < b.height(); y += spacing)
    for (int x = 0; x < b.width(); x += spacing)
      for (int k = 0; k < map.at(x, y); ++k) {
        const size_t pixel = static_cast<size_t>(y) * b.width() + x;
        const Sample& sample = samples_[pixel * most_ + k];
        variance.add(x, y, sample.light + (splatted_.empty() ? 0.0 : splatted_[pixel]),
                     sample.rays);
      }
}

}  // namespace nephroid
