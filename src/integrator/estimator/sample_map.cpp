#include "integrator/estimator/sample_map.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

int SampleMap::most() const {
  return *std::max_element(counts_.begin(), counts_.end());
}

int SampleMap::fewest() const {
  return *std::min_element(counts_.begin(), counts_.end());
}

bool SampleMap::has(int samples) const {
  return std::find(counts_.begin(), counts_.end(), samples) != counts_.end();
}

double SampleMap::mean() const {
  double sum = 0;
  for (const uint16_t n : counts_) sum += n;
  return sum / static_cast<double>(counts_.size());
}

bool SampleMap::has_tiles_of(const SampleMap& other) const {
  return tile_ == other.tile_ && width_ == other.width_ && counts_.size() == other.counts_.size();
}

bool SampleMap::is_sound(const PixelBounds& b, int spacing, int min, int max) const {
  return (has_tiles_of(SampleMap(b)) || has_tiles_of(SampleMap(b, 1, spacing))) &&
         fewest() >= min && most() <= max;
}

void SampleVariance::add(const SampleVariance& other) {
  for (size_t i = 0; i < sums_.size(); ++i) {
    sums_[i].light += other.sums_[i].light;
    sums_[i].square += other.sums_[i].square;
    sums_[i].photons += other.sums_[i].photons;
    sums_[i].rays += other.sums_[i].rays;
    sums_[i].samples += other.sums_[i].samples;
  }
}

SampleVariance::ByTile SampleVariance::by_tile(const SampleVariance* others) const {
  const SampleMap tiles(bounds_, 1, spacing_);
  const ByTile other = others ? others->by_tile() : ByTile{};
  ByTile out;
  out.variance.assign(tiles.counts().size(), 0);
  out.cost = out.variance;
  out.light = out.brightness = out.photons = out.typical = out.variance;
  std::vector<double> pixels(out.variance);
  double all_light = 0, all_pixels = 0;
  size_t i = 0;
  for (int y = 0; y < bounds_.height(); y += spacing_)
    for (int x = 0; x < bounds_.width(); x += spacing_) {
      const Sums& s = sums_[i++];
      if (s.samples < 2) continue;
      const size_t tile = tiles.tile_of(x, y);
      const double mean = s.light / s.samples;
      out.cost[tile] += s.rays / s.samples;
      const double variance = std::max(0.0, (s.square - mean * s.light) / (s.samples - 1));
      out.variance[tile] += variance;
      out.typical[tile] += std::sqrt(variance);
      out.photons[tile] += s.photons / s.samples;
      out.light[tile] += std::abs(mean);
      all_light += std::abs(mean) + (others ? other.light[tile] : 0);
      ++pixels[tile];
      ++all_pixels;
    }
  // A compromise between the absolute error, which neglects dark pixels, and the relative error,
  // which neglects bright ones.
  const double floor = 0.1 * all_light / std::max(1.0, all_pixels);
  for (size_t t = 0; t < out.variance.size(); ++t) {
    if (!(pixels[t] > 0)) continue;
    out.light[t] /= pixels[t];
    const double brightness = out.light[t] + (others ? other.light[t] : 0) + floor;
    out.brightness[t] = brightness;
    out.variance[t] = brightness > 0 ? out.variance[t] / (pixels[t] * brightness) : 0;
    out.typical[t] = brightness > 0 ? sqr(out.typical[t] / pixels[t]) / brightness : 0;
    out.photons[t] = brightness > 0 ? out.photons[t] / (pixels[t] * brightness) : 0;
    out.cost[t] /= pixels[t];
  }
  return out;
}

}  // namespace nephroid
