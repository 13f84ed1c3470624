// All arithmetic between the accumulators and the returned floats is in double.
#include "film/film.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/parallel.h"

namespace nephroid {
namespace {

Rgb to_rgb(const double (&v)[3]) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// Variance of the mean of n estimates with the given sum and sum of squares.
double variance_of_mean(const FixedSum& sum, const FixedSum& square, uint64_t n) {
  const double count = static_cast<double>(n);
  const double mean = sum.value() / count;
  const double variance = square.value() / count - mean * mean;
  return std::max(0.0, variance) / (count - 1.0);
}

}  // namespace

Film::Film(const FilmSettings& settings, FilmLayout layout)
    : format_(settings, std::move(layout)), slices_(bounds()) {
  const int groups = this->layout().group_count();
  list_buffers();
  const size_t pixels = bounds().area();
  for (size_t r = 0; r < this->layout().routes.size(); ++r) sums_.emplace_back(pixels);
  for (const std::vector<size_t>& layers : layers_of_group_)
    for (size_t i = 0; i < layers.size(); ++i) layers_.emplace_back(pixels);
  for (int g = 0; g < groups; ++g) squares_.emplace_back(pixels, PixelSums::kSquareBits);
  estimates_.assign(groups + 1, 0);
  open_.assign(groups + 1, OpenPass{std::vector<uint32_t>(slices_.count(), 0)});
  for (int g = 0; g < groups; ++g) {
    if (!this->layout().group_merges(g)) continue;
    biases_.resize(groups);
    biases_[g] = ZeroedArray<Bias>(pixels);
  }
  features_ = ZeroedArray<Features>(pixels);
  depths_ = ZeroedArray<uint64_t>(pixels);
  if (this->settings().gbuffer) {
    surfaces_ = ZeroedArray<SurfaceSums>(pixels);
    surface_samples_ = ZeroedArray<uint64_t>(pixels);
  }
  bad_.resize(this->layout().routes.size());
}

void Film::list_buffers() {
  const FilmLayout& layout = this->layout();
  routes_of_group_.resize(layout.group_count());
  layers_of_group_.resize(layout.group_count());
  layers_of_aov_.resize(layout.aovs.size());
  layers_of_part_.resize(layout.parts.size());
  for (size_t r = 0; r < layout.routes.size(); ++r) routes_of_group_[layout.groups[r]].push_back(r);
  for (int g = 0; g < layout.group_count(); ++g)
    for (const size_t route : routes_of_group_[g]) routes_.push_back({g, route});
  const std::vector<FilmLayout::GroupLayer> layers = layout.layers_of_groups();
  for (size_t i = 0; i < layers.size(); ++i) {
    layers_of_group_[layers[i].group].push_back(i);
    layers_of_aov_[layers[i].aov].push_back({layers[i].group, i});
  }
  for (size_t p = 0; p < layout.parts.size(); ++p)
    for (const int aov : layout.parts[p].aovs) {
      const FilmLayout::GroupLayer layer{layout.group_of(layout.parts[p]), aov};
      layers_of_part_[p].push_back(std::ranges::lower_bound(layers, layer) - layers.begin());
    }
}

size_t Film::bytes_per_pixel(const FilmLayout& layout, bool gbuffer) {
  const size_t sums =
      layout.routes.size() + layout.layers_of_groups().size() + layout.group_count();
  const size_t merging = std::count(layout.merges.begin(), layout.merges.end(), true);
  return sums * PixelSums::kBytesPerPixel + layout.group_count() * PixelSums::kCarryBytesPerPixel +
         merging * sizeof(Bias) + sizeof(Features) +
         (gbuffer ? sizeof(SurfaceSums) + sizeof(uint64_t) : 0) + sizeof(uint64_t);  // depths
}

bool Film::add_parts(int group, size_t pixel, std::span<const Rgb> values) {
  const std::vector<int>& parts = parts_of(group);
  bool fits = true;
  for (size_t i = 0; i < parts.size(); ++i) {
    fits &= sums_[route_of(parts[i])].add(pixel, values[i]);
    for (const size_t layer : layers_of_part_[parts[i]])
      fits &= layers_[layer].add(pixel, values[i]);
  }
  return fits;
}

bool Film::add_square(int group, size_t pixel, std::span<const Rgb> values) {
  RgbSum square;
  bool fits = true;
  for (int c = 0; c < 3; ++c) {
    double total = 0;
    for (const Rgb& value : values) total += double{value[c]};
    fits &= square.rgb[c].add(total * total);
  }
  return squares_[group].add(pixel, square) && fits;
}

void Film::add(int group, int x, int y, std::span<const Rgb> values) {
  assert(values.size() == parts_of(group).size());
  const size_t pixel = index(x, y);
  if (is_bad(group, x, y, values)) return;
  const bool is_held =
      outliers_ && outliers_->hold(group, pixel, values, [this](int g, size_t p, const auto& held) {
        release(g, p, held);
      });
  bool fits = is_held || add_parts(group, pixel, values);
  fits &= add_square(group, pixel, values);
  if (!fits) count_saturated(1);
}

void Film::replace(int group, int x, int y, std::span<const Rgb> values) {
  assert(values.size() == parts_of(group).size());
  const size_t pixel = index(x, y);
  if (is_bad(group, x, y, values)) return;
  for (const size_t route : routes_of_group_[group]) sums_[route].clear(pixel);
  for (const size_t layer : layers_of_group_[group]) layers_[layer].clear(pixel);
  squares_[group].clear(pixel);
  bool fits = add_parts(group, pixel, values);
  fits &= add_square(group, pixel, values);
  if (!fits) count_saturated(1);
}

void Film::add_bias(int group, std::span<const float> of_pixels) {
  if (!layout().group_merges(group)) return;
  assert(of_pixels.size() == biases_[group].size());
  parallel_chunks(of_pixels.size(), 1 << 14, [&](int64_t, int64_t begin, int64_t end) {
    for (int64_t i = begin; i < end; ++i) add_bias_of(group, i, of_pixels[i]);
  });
}

void Film::add_bias(int group, int x, int y, float bias) {
  if (layout().group_merges(group)) add_bias_of(group, index(x, y), bias);
}

void Film::add_bias_of(int group, size_t pixel, float value) {
  const double b = double{value};
  Bias& bias = biases_[group][pixel];
  if (!std::isfinite(b) || !(bias.sum.add(b) && bias.square.add(b * b))) count_saturated(1);
}

void Film::release(int group, size_t pixel, std::span<const RgbSum> held) {
  const std::vector<int>& parts = parts_of(group);
  bool fits = true;
  for (size_t i = 0; i < parts.size(); ++i) {
    fits &= sums_[route_of(parts[i])].add(pixel, held[i]);
    for (const size_t layer : layers_of_part_[parts[i]]) fits &= layers_[layer].add(pixel, held[i]);
  }
  if (!fits) count_saturated(1);
}

void Film::reject_outliers(OutlierSettings settings) {
  std::vector<size_t> parts;
  for (int g = 0; g < layout().group_count(); ++g) parts.push_back(parts_of(g).size());
  outliers_.emplace(bounds().width(), bounds().height(), std::move(parts), std::move(settings));
}

void Film::finish_pass() {
  if (!outliers_) return;
  const PixelBounds& b = bounds();
  std::vector<float> shown(b.area());
  parallel_chunks(b.height(), 16, [&](int64_t, int64_t begin, int64_t end) {
    for (int y = b.y0 + static_cast<int>(begin); y < b.y0 + static_cast<int>(end); ++y)
      for (int x = b.x0; x < b.x1; ++x)
        shown[index(x, y)] = OutlierRejection::brightness(value(x, y));
  });
  for (int g = 0; g < layout().group_count(); ++g)
    outliers_->finish_pass(
        g, estimates(g), shown,
        [this](int group, size_t pixel, const auto& held) { release(group, pixel, held); });
}

void Film::add_estimates(int group, uint64_t count) {
  estimates_[group] += count;
  OpenPass& open = open_[group];
  if (open.slices > 0) open = OpenPass{std::vector<uint32_t>(slices_.count(), 0)};
}
void Film::set_estimates(int group, uint64_t count) {
  estimates_[group] = count;
}
uint64_t Film::estimates(int group) const {
  return estimates_[group];
}
void Film::count_bad(int group, size_t part, const Vec2i& pixel) {
  const auto route = route_of(parts_of(group)[part]);
  BadEstimates& bad = bad_[route];
  std::atomic_ref(bad.count).fetch_add(1, std::memory_order_relaxed);
  const PixelBounds& crop = bounds();
  if (pixel.x < crop.x0 || pixel.x >= crop.x1 || pixel.y < crop.y0 || pixel.y >= crop.y1) return;
  const uint64_t at = index(pixel.x, pixel.y);
  const std::atomic_ref first(bad.first_pixel);
  for (uint64_t seen = first.load(); at < seen && !first.compare_exchange_weak(seen, at);) {
  }
}

void Film::count_saturated(uint64_t sums) {
  std::atomic_ref(saturated_).fetch_add(sums, std::memory_order_relaxed);
}

bool Film::is_bad(int group, int x, int y, std::span<const Rgb> values) {
  for (size_t part = 0; part < values.size(); ++part)
    if (!values[part].is_finite()) {
      count_bad(group, part, {x, y});
      return true;
    }
  return false;
}

void Film::add_features(int x, int y, const Rgb& albedo, const Vec3f& normal, float depth) {
  const size_t pixel = index(x, y);
  Features& features = features_[pixel];
  bool fits = true;
  for (int c = 0; c < 3; ++c) {
    fits &= features.albedo[c].add(albedo[c]);
    fits &= features.normal[c].add(normal[c]);
  }
  if (!(depth <= 0) && depth != kInfinity) {
    const bool depth_fits = features.depth.add(depth);
    if (depth_fits) ++depths_[pixel];
    fits &= depth_fits;
  }
  if (!fits) count_saturated(1);
}
void Film::add_feature_estimates(uint64_t count) {
  add_estimates(layout().group_count(), count);
}

void Film::add_surface(int x, int y, const SurfaceSample& s) {
  if (surfaces_.empty()) return;
  const size_t pixel = index(x, y);
  const std::array<float, 13> values{s.p.x,  s.p.y,  s.p.z,  s.n.x,  s.n.y,  s.n.z, s.ns.x,
                                     s.ns.y, s.ns.z, s.uv.x, s.uv.y, s.dzdx, s.dzdy};
  bool fits = true;
  for (size_t i = 0; i < values.size(); ++i) fits &= surfaces_[pixel][i].add(values[i]);
  if (!fits) count_saturated(1);
  ++surface_samples_[pixel];
}

/// [F1]: sums with the same count of estimates are added exactly before the division.
template <class SumOf>
Rgb Film::mean_of(std::span<const Term> terms, size_t pixel, const SumOf& sum_of) const {
  double total[3] = {0, 0, 0};
  for (size_t begin = 0, end = 0; begin < terms.size(); begin = end) {
    int group = terms[begin].group;
    const size_t at = nearest_reached(group, pixel);
    const uint64_t count = count_of(group, at);
    const auto counts_likewise = [&](int other) {
      return other == group ||
             (count_of(other, at) == count && nearest_reached(other, pixel) == at);
    };
    RgbSum sum;
    for (end = begin; end < terms.size() && counts_likewise(terms[end].group); ++end) {
      group = terms[end].group;
      sum.add(sum_of(terms[end].buffer, at));
    }
    if (count == 0) continue;
    for (int c = 0; c < 3; ++c) total[c] += sum.rgb[c].value() / static_cast<double>(count);
  }
  return to_rgb(total);
}

Rgb Film::mean_of_routes(std::span<const Term> terms, size_t pixel) const {
  return mean_of(terms, pixel, [this](size_t r, size_t p) { return sums_[r].sum(p); });
}

Rgb Film::route_value(int route, int x, int y) const {
  const Term term{layout().groups[route], static_cast<size_t>(route)};
  return mean_of_routes({&term, 1}, index(x, y));
}
Rgb Film::aov_value(int aov, int x, int y) const {
  return mean_of(layers_of_aov_[aov], index(x, y),
                 [this](size_t layer, size_t p) { return layers_[layer].sum(p); });
}
Rgb Film::value(int x, int y) const {
  return mean_of_routes(routes_, index(x, y));
}

uint64_t Film::samples(int x, int y) const {
  uint64_t samples = 0;
  for (int g = 0; g < layout().group_count(); ++g) samples = std::max(samples, estimates(g, x, y));
  return samples;
}

Rgb Film::outliers(int x, int y) const {
  double total[3] = {0, 0, 0};
  for (int g = 0; outliers_ && g < layout().group_count(); ++g) {
    const uint64_t count = estimates(g, x, y);
    if (count == 0) continue;
    const RgbSum held = outliers_->held(g, index(x, y));
    for (int c = 0; c < 3; ++c) total[c] += held.rgb[c].value() / static_cast<double>(count);
  }
  return to_rgb(total);
}

std::array<double, 3> Film::error_squared(size_t group, size_t pixel) const {
  std::array<double, 3> squared{};
  const uint64_t count = count_of(group, pixel);
  if (count < 2) return squared;
  RgbSum sum = outliers_ ? outliers_->held(static_cast<int>(group), pixel) : RgbSum();
  for (const size_t route : routes_of_group_[group]) sum.add(sums_[route].sum(pixel));
  const RgbSum square = squares_[group].sum(pixel);
  for (size_t c = 0; c < 3; ++c) squared[c] = variance_of_mean(sum.rgb[c], square.rgb[c], count);
  return squared;
}

Rgb Film::standard_error(int x, int y) const {
  double error[3] = {0, 0, 0};
  for (size_t g = 0; g < squares_.size(); ++g) {
    const std::array<double, 3> squared = error_squared(g, index(x, y));
    for (size_t c = 0; c < 3; ++c) error[c] += squared[c];
  }
  for (double& e : error) e = std::sqrt(e);
  return to_rgb(error);
}

Rgb Film::standard_error(int group, int x, int y) const {
  const std::array<double, 3> squared = error_squared(group, index(x, y));
  return to_rgb({std::sqrt(squared[0]), std::sqrt(squared[1]), std::sqrt(squared[2])});
}

float Film::bias(int x, int y) const {
  double sum = 0;
  for (size_t g = 0; g < biases_.size(); ++g)
    if (const uint64_t count = count_of(g, index(x, y)); !biases_[g].empty() && count > 0)
      sum += biases_[g][index(x, y)].sum.value() / static_cast<double>(count);
  return static_cast<float>(sum);
}

float Film::bias_error(int x, int y) const {
  double sum = 0;
  for (size_t g = 0; g < biases_.size(); ++g) {
    const uint64_t count = count_of(g, index(x, y));
    if (biases_[g].empty() || count < 2) continue;
    const Bias& bias = biases_[g][index(x, y)];
    sum += variance_of_mean(bias.sum, bias.square, count);
  }
  return static_cast<float>(std::sqrt(sum));
}

Rgb Film::albedo(int x, int y) const {
  const size_t group = layout().group_count(), pixel = nearest_reached(group, index(x, y));
  const uint64_t count = count_of(group, pixel);
  if (count == 0) return {};
  const Features& features = features_[pixel];
  double mean[3];
  for (int c = 0; c < 3; ++c) mean[c] = features.albedo[c].value() / static_cast<double>(count);
  return to_rgb(mean);
}

Vec3f Film::normal(int x, int y) const {
  const Features& features = features_[nearest_reached(layout().group_count(), index(x, y))];
  const double n[3] = {features.normal[0].value(), features.normal[1].value(),
                       features.normal[2].value()};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {0, 0, 0};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
          static_cast<float>(n[2] / length)};
}

float Film::depth(int x, int y) const {
  const size_t pixel = nearest_reached(layout().group_count(), index(x, y));
  if (depths_[pixel] == 0) return 0;
  return static_cast<float>(features_[pixel].depth.value() / static_cast<double>(depths_[pixel]));
}

SurfaceSample Film::surface(int x, int y) const {
  SurfaceSample s;
  if (surfaces_.empty()) return s;
  const SurfaceSums& surface = surfaces_[index(x, y)];
  const uint64_t samples = surface_samples_[index(x, y)];
  if (samples == 0) return s;
  const auto mean = [&](size_t i) {
    return static_cast<float>(surface[i].value() / static_cast<double>(samples));
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

}  // namespace nephroid
