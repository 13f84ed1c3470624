// What film.h declares: adding, and the statistics that are read off the sums.
// All arithmetic between the accumulators and the returned floats is in double.
#include "film/film.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace nephroid {
namespace {

bool is_finite(const Rgb& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

Rgb to_rgb(const double (&v)[3]) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// Variance of the mean of n estimates with the given sum and sum of squares.
double variance_of_mean(const FixedSum& sum, const FixedSum& square, uint64_t n) {
  const double count = static_cast<double>(n);
  const double mean = sum.value() / count;
  const double spread = square.value() / count - mean * mean;
  return std::max(0.0, spread) / (count - 1.0);
}

}  // namespace

Film::Film(const FilmSettings& settings, std::vector<std::string> routes)
    : settings_(settings), route_names_(std::move(routes)) {
  if (settings_.crop.width() <= 0 || settings_.crop.height() <= 0)
    settings_.crop = {0, 0, settings_.width, settings_.height};
  const auto pixels = static_cast<size_t>(settings_.crop.area());
  sums_.assign(route_names_.size(), std::vector<PixelSums>(pixels));
  estimates_.assign(route_names_.size(), 0);
  features_.resize(pixels);
  if (settings_.gbuffer) surfaces_.resize(pixels);
  bad_.assign(pixels, 0);
  saturated_.assign(pixels, 0);
}

Rgb clamp_component(const Rgb& rgb, float limit) {
  const float largest = std::max({std::abs(rgb.r), std::abs(rgb.g), std::abs(rgb.b)});
  return largest > limit ? rgb * (limit / largest) : rgb;
}

void Film::add(int route, int x, int y, const Rgb& value) {
  const size_t pixel = index(x, y);
  if (!is_finite(value)) {
    ++bad_[pixel];
    return;
  }
  PixelSums& sums = sums_[static_cast<size_t>(route)][pixel];
  bool fits = true;
  for (int c = 0; c < 3; ++c) {
    const double component = value[c];
    fits &= sums.sum[c].add(component);
    fits &= sums.square[c].add(component * component);
  }
  if (!fits) ++saturated_[pixel];
}

void Film::replace(int route, int x, int y, const Rgb& value) {
  const size_t pixel = index(x, y);
  if (!is_finite(value)) {
    ++bad_[pixel];
    return;
  }
  PixelSums sums;
  bool fits = true;
  for (int c = 0; c < 3; ++c) {
    const double component = value[c];
    fits &= sums.sum[c].add(component);
    fits &= sums.square[c].add(component * component);
  }
  if (!fits) ++saturated_[pixel];
  sums_[static_cast<size_t>(route)][pixel] = sums;
}

void Film::add_estimates(int route, uint64_t count) {
  estimates_[static_cast<size_t>(route)] += count;
}
void Film::set_estimates(int route, uint64_t count) {
  estimates_[static_cast<size_t>(route)] = count;
}
uint64_t Film::estimates(int route) const {
  return estimates_[static_cast<size_t>(route)];
}

void Film::add_features(int x, int y, const Rgb& albedo, const Vec3f& normal, float depth) {
  Features& features = features_[index(x, y)];
  for (int c = 0; c < 3; ++c) {
    features.albedo[c].add(albedo[c]);
    features.normal[c].add(normal[c]);
  }
  if (depth > 0 && features.depth.add(depth)) ++features.depths;
}
void Film::add_feature_estimates(uint64_t count) {
  feature_estimates_ += count;
}

void Film::add_surface(int x, int y, const SurfaceSample& s) {
  if (surfaces_.empty()) return;
  SurfaceSums& surface = surfaces_[index(x, y)];
  const std::array<float, 13> values{s.p.x,  s.p.y,  s.p.z,  s.n.x,  s.n.y,  s.n.z, s.ns.x,
                                     s.ns.y, s.ns.z, s.uv.x, s.uv.y, s.dzdx, s.dzdy};
  for (size_t i = 0; i < values.size(); ++i) surface.sums[i].add(values[i]);
  ++surface.samples;
}

Rgb Film::route_value(int route, int x, int y) const {
  const auto r = static_cast<size_t>(route);
  if (estimates_[r] == 0) return {};
  const PixelSums& sums = sums_[r][index(x, y)];
  double mean[3];
  for (int c = 0; c < 3; ++c) mean[c] = sums.sum[c].value() / static_cast<double>(estimates_[r]);
  return to_rgb(mean);
}

Rgb Film::value(int x, int y) const {
  const size_t pixel = index(x, y);
  double total[3] = {0, 0, 0};
  const bool same_count = std::adjacent_find(estimates_.begin(), estimates_.end(),
                                             std::not_equal_to<>()) == estimates_.end();
  for (int c = 0; c < 3; ++c) {
    if (same_count && !estimates_.empty() && estimates_[0] > 0) {
      // One division for all routes: the accumulators are added exactly first.
      FixedSum sum;
      for (const auto& route : sums_) sum.add(route[pixel].sum[c]);
      total[c] = sum.value() / static_cast<double>(estimates_[0]);
      continue;
    }
    for (size_t r = 0; r < sums_.size(); ++r)
      if (estimates_[r] > 0)
        total[c] += sums_[r][pixel].sum[c].value() / static_cast<double>(estimates_[r]);
  }
  return to_rgb(total);
}

Rgb Film::standard_error(int x, int y) const {
  const size_t pixel = index(x, y);
  double error[3] = {0, 0, 0};
  for (int c = 0; c < 3; ++c) {
    double variance = 0;
    for (size_t r = 0; r < sums_.size(); ++r) {
      if (estimates_[r] < 2) continue;
      const PixelSums& sums = sums_[r][pixel];
      variance += variance_of_mean(sums.sum[c], sums.square[c], estimates_[r]);
    }
    error[c] = std::sqrt(variance);
  }
  return to_rgb(error);
}

Rgb Film::albedo(int x, int y) const {
  if (feature_estimates_ == 0) return {};
  const Features& features = features_[index(x, y)];
  double mean[3];
  for (int c = 0; c < 3; ++c)
    mean[c] = features.albedo[c].value() / static_cast<double>(feature_estimates_);
  return to_rgb(mean);
}

Vec3f Film::normal(int x, int y) const {
  const Features& features = features_[index(x, y)];
  const double n[3] = {features.normal[0].value(), features.normal[1].value(),
                       features.normal[2].value()};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {0, 0, 0};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
          static_cast<float>(n[2] / length)};
}

float Film::depth(int x, int y) const {
  const Features& features = features_[index(x, y)];
  if (features.depths == 0) return 0;
  return static_cast<float>(features.depth.value() / static_cast<double>(features.depths));
}

SurfaceSample Film::surface(int x, int y) const {
  SurfaceSample s;
  if (surfaces_.empty()) return s;
  const SurfaceSums& surface = surfaces_[index(x, y)];
  if (surface.samples == 0) return s;
  const auto mean = [&](size_t i) {
    return static_cast<float>(surface.sums[i].value() / static_cast<double>(surface.samples));
  };
  const auto direction = [&](size_t i) {
    return normalize(Vec3f(mean(i), mean(i + 1), mean(i + 2)));
  };
  s.p = Vec3f(mean(0), mean(1), mean(2));
  s.n = direction(3);
  s.ns = direction(6);
  s.uv = Vec2f(mean(9), mean(10));
  s.dzdx = std::abs(mean(11));
  s.dzdy = std::abs(mean(12));
  return s;
}

uint64_t Film::bad_values() const {
  return std::accumulate(bad_.begin(), bad_.end(), uint64_t{0});
}
uint64_t Film::saturated_values() const {
  return std::accumulate(saturated_.begin(), saturated_.end(), uint64_t{0});
}

}  // namespace nephroid
