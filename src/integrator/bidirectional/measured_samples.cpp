#include "integrator/bidirectional/measured_samples.h"

#include <cmath>

namespace nephroid {

MeasuredSamples::MeasuredSamples(const FilmFormat& film, size_t most)
    : film_(film),
      spacing_(PixelSlices(film.bounds()).spacing(1)),
      width_((film.bounds().width() + spacing_ - 1) / spacing_),
      samples_(PixelSlices(film.bounds()).first_pixels() * most),
      most_(most) {}

void MeasuredSamples::add_splats(std::span<const Splat> splats, float light_paths) {
  const PixelBounds& b = film_.bounds();
  splatted_.resize(samples_.size() / most_);
  for (const Splat& splat : splats) {
    const int x = static_cast<int>(std::floor(splat.film.x)),
              y = static_cast<int>(std::floor(splat.film.y));
    if (x < b.x0 || y < b.y0 || x >= b.x1 || y >= b.y1) continue;
    const float sum = splat.value.r + splat.value.g + splat.value.b;
    splatted_[pixel_of(x, y)] += sum / 3.0f / light_paths;
  }
}

void MeasuredSamples::add_to(SampleVariance& variance, const SampleMap& map) const {
  const PixelBounds& b = film_.bounds();
  for (int y = 0; y < b.height(); y += spacing_)
    for (int x = 0; x < b.width(); x += spacing_)
      for (int k = 0; k < map.at(x, y); ++k) {
        const size_t pixel = pixel_of(b.x0 + x, b.y0 + y);
        const Sample& sample = samples_[pixel * most_ + k];
        variance.add(x, y, sample.light + (splatted_.empty() ? 0.0 : splatted_[pixel]),
                     sample.rays);
      }
}

}  // namespace nephroid
