// Splats are sorted into strips of rows, and each strip is summed by one task. A splat that reaches
// two strips is in both lists.
#include "film/splats.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/parallel.h"

namespace nephroid {
namespace {

constexpr int kRowsPerStrip = 16;
/// Splats in a batch: bounds the memory of the lists.
constexpr size_t kSplatsPerBatch = size_t{1} << 20;

/// The integers i in [lowest, highest) with -radius <= x - (i + 1/2) < radius, as a half-open
/// range. So a point on the border of two boxes belongs to one of them.
struct Range {
  int begin, end;
};
Range pixels_around(double x, double radius, int lowest, int highest) {
  const double low = lowest, high = highest;
  const double after_begin = std::floor(x - radius - 0.5) + 1;
  const double after_end = std::floor(x + radius - 0.5) + 1;
  return {static_cast<int>(std::clamp(after_begin, low, high)),
          static_cast<int>(std::clamp(after_end, low, high))};
}

bool is_usable(const Splat& splat) {
  return splat.value.is_finite() && !std::isnan(splat.film.x) && !std::isnan(splat.film.y);
}

/// The pixel of a film point; outside of every film if the point is NaN or far away.
Vec2i pixel_of(const Vec2f& film) {
  const auto coordinate = [](float x) {
    return std::abs(x) < 1e9f ? static_cast<int>(std::floor(x)) : -1;
  };
  return {coordinate(film.x), coordinate(film.y)};
}

}  // namespace

SplatBuffer::SplatBuffer(Film& film, int group, const PixelFilter& filter)
    : film_(film), group_(group), filter_(filter), parts_(film.parts_of(group).size()) {
  sums_.resize(film.bounds().area() * parts_);
}

PixelBounds SplatBuffer::reached_by(const Vec2f& film) const {
  const PixelBounds& crop = film_.bounds();
  const Vec2f radius = filter_.radius();
  const Range x = pixels_around(film.x, radius.x, crop.x0, crop.x1);
  const Range y = pixels_around(film.y, radius.y, crop.y0, crop.y1);
  return {x.begin, y.begin, x.end, y.end};
}

void SplatBuffer::add(std::span<const Splat> splats) {
  while (!splats.empty()) {
    const size_t count = std::min(splats.size(), kSplatsPerBatch);
    add_batch(splats.first(count));
    splats = splats.subspan(count);
  }
}

std::vector<std::vector<uint32_t>> SplatBuffer::splats_by_strip(std::span<const Splat> splats) {
  const PixelBounds& crop = film_.bounds();
  std::vector<std::vector<uint32_t>> strips(chunk_count(crop.height(), kRowsPerStrip));
  for (size_t i = 0; i < splats.size(); ++i) {
    if (!is_usable(splats[i])) {
      bad_.push_back({splats[i].part, pixel_of(splats[i].film)});
      continue;
    }
    const PixelBounds reached = reached_by(splats[i].film);
    if (reached.x0 >= reached.x1 || reached.y0 >= reached.y1) continue;
    const int last = (reached.y1 - 1 - crop.y0) / kRowsPerStrip;
    for (int s = (reached.y0 - crop.y0) / kRowsPerStrip; s <= last; ++s)
      strips[s].push_back(static_cast<uint32_t>(i));
  }
  return strips;
}

void SplatBuffer::add_batch(std::span<const Splat> splats) {
  const std::vector<std::vector<uint32_t>> strips = splats_by_strip(splats);
  const int top = film_.bounds().y0;
  std::vector<uint64_t> held(strips.size(), 0);
  parallel_chunks(
      film_.bounds().height(), kRowsPerStrip, [&](int64_t s, int64_t begin, int64_t end) {
        for (const uint32_t i : strips[s])
          held[s] +=
              add_to_rows(splats[i], top + static_cast<int>(begin), top + static_cast<int>(end));
      });
  saturated_ += std::accumulate(held.begin(), held.end(), uint64_t{0});
}

uint64_t SplatBuffer::add_to_rows(const Splat& splat, int y0, int y1) {
  assert(splat.part < parts_);
  const PixelBounds& crop = film_.bounds();
  const PixelBounds reached = reached_by(splat.film);
  uint64_t held = 0;
  for (int y = std::max(y0, reached.y0); y < std::min(y1, reached.y1); ++y) {
    const size_t row = static_cast<size_t>(y - crop.y0) * crop.width();
    const auto dy = static_cast<float>(double{splat.film.y} - y - 0.5);
    for (int x = reached.x0; x < reached.x1; ++x) {
      const auto dx = static_cast<float>(double{splat.film.x} - x - 0.5);
      const double weight = filter_.eval({dx, dy});
      Sum& sum = sums_[(row + (x - crop.x0)) * parts_ + splat.part];
      bool fits = true;
      for (int c = 0; c < 3; ++c) fits &= sum.rgb[c].add(weight * double{splat.value[c]});
      held += fits ? 0 : 1;
    }
  }
  return held;
}

void SplatBuffer::finish(double scale, std::span<const Rgb> also) {
  if (parts_ == 0) return;
  for (const BadSplat& splat : bad_) film_.count_bad(group_, splat.part, splat.pixel);
  film_.count_saturated(saturated_);
  bad_.clear();
  saturated_ = 0;
  const PixelBounds& crop = film_.bounds();
  const double limit = film_.settings().max_component;
  parallel_chunks(crop.height(), kRowsPerStrip, [&](int64_t, int64_t begin, int64_t end) {
    std::vector<Rgb> values(parts_);
    for (int y = crop.y0 + static_cast<int>(begin); y < crop.y0 + static_cast<int>(end); ++y)
      for (int x = crop.x0; x < crop.x1; ++x) {
        const size_t first =
            (static_cast<size_t>(y - crop.y0) * crop.width() + (x - crop.x0)) * parts_;
        double total[3] = {0, 0, 0};
        const auto found = [&](size_t i, size_t c) {
          const double other = also.empty() ? 0.0 : double{also[first + i][static_cast<int>(c)]};
          return sums_[first + i].rgb[c].value() * scale + other;
        };
        for (size_t i = 0; i < parts_; ++i)
          for (size_t c = 0; c < 3; ++c) total[c] += found(i, c);
        // Scaled so that no component of the total exceeds the limit; hue and sign are kept.
        const double largest =
            std::max({std::abs(total[0]), std::abs(total[1]), std::abs(total[2])});
        const double factor = largest > limit ? limit / largest : 1.0;
        for (size_t i = 0; i < parts_; ++i) {
          const auto kept = [&](size_t c) { return static_cast<float>(found(i, c) * factor); };
          values[i] = {kept(0), kept(1), kept(2)};
        }
        for (size_t i = 0; i < parts_; ++i) sums_[first + i] = {};
        film_.add(group_, x, y, values);
      }
  });
}

}  // namespace nephroid
