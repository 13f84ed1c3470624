#include "integrator/bidirectional/measured_samples.h"

#include "film/pixel_slices.h"

namespace nephroid {

MeasuredSamples::MeasuredSamples(const FilmFormat& film, size_t most)
    : film_(film),
      spacing_(PixelSlices(film.bounds()).spacing(1)),
      width_((film.bounds().width() + spacing_ - 1) / spacing_),
      samples_(PixelSlices(film.bounds()).first_pixels() * most),
      most_(most) {}

void MeasuredSamples::add_to(SampleVariance& variance, const SampleMap& map) const {
  const PixelBounds& b = film_.bounds();
  for (int y = 0; y < b.height(); y += spacing_)
    for (int x = 0; x < b.width(); x += spacing_)
      for (int k = 0; k < map.at(x, y); ++k) {
        const size_t pixel = pixel_of(b.x0 + x, b.y0 + y);
        const Sample& sample = samples_[pixel * most_ + k];
        variance.add(x, y, sample.light, sample.cost);
        variance.add_photons(x, y, sample.photon_squares);
      }
}

}  // namespace nephroid
