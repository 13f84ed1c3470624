// An implicit k-d tree whose nodes are the middles of ranges, and the lobes of [T1].
#include "photon/forecast_map.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace nephroid {

namespace {

// Narrowest lobe: the caster is rarely known better, and single precision is still exact.
constexpr float kNarrowest = 0.01f;
// Widest lobe: a wider one would say little and still take half of the samples.
constexpr float kWidest = 0.5f;
// Lobes overlap, so each may be narrower than the distance to the furthest record suggests.
constexpr float kWidthOfReach = 0.5f;

/// Distance from the i-th of the axes to the second nearest other one; 0 if there are none.
float gap_beside(std::span<const Vec3f> axes, size_t i) {
  float first = kInfinity, second = kInfinity;
  for (size_t j = 0; j < axes.size(); ++j) {
    if (j == i) continue;
    const float d = length_squared(axes[j] - axes[i]);
    second = std::min(second, std::max(first, d));
    first = std::min(first, d);
  }
  return second < kInfinity ? std::sqrt(second) : 0.0f;
}

}  // namespace

void ForecastLobes::add(const Vec3f& axis, float width) {
  const float k = 1.0f / sqr(std::max(width, kNarrowest));
  lobes_[count_++] = {axis, k, k / (-2.0f * kPi * std::expm1(-2.0f * k))};
}

Vec3f ForecastLobes::sample(float& uc, const Vec2f& u) const {
  const float scaled = uc * static_cast<float>(count_);
  const int i = std::min(static_cast<int>(scaled), count_ - 1);
  uc = scaled - static_cast<float>(i);
  const Lobe& lobe = lobes_[i];
  // 1 - cos(theta), since cos(theta) may round to 1.
  const float k = lobe.concentration;
  const float t = std::clamp(-std::log1p(u.x * std::expm1(-2.0f * k)) / k, 0.0f, 2.0f);
  const float sine = safe_sqrt(t * (2.0f - t)), phi = 2.0f * kPi * u.y;
  return normalize(
      Frame::from_z(lobe.axis).to_world({sine * std::cos(phi), sine * std::sin(phi), 1.0f - t}));
}

float ForecastLobes::pdf_w(const Vec3f& w) const {
  float sum = 0;
  for (int i = 0; i < count_; ++i) {
    const Lobe& lobe = lobes_[i];
    const float t = 0.5f * length_squared(w - lobe.axis);
    sum += lobe.norm * std::exp(-lobe.concentration * t);
  }
  return count_ > 0 ? sum / static_cast<float>(count_) : 0.0f;
}

ForecastMap::ForecastMap(std::vector<CausticRecord> records)
    : records_(std::move(records)), axes_(records_.size()) {
  build(0, records_.size());
}

void ForecastMap::build(size_t begin, size_t end) {
  if (end - begin < 2) return;
  Vec3f low = records_[begin].p, high = low;
  for (size_t i = begin; i < end; ++i)
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], records_[i].p[a]);
      high[a] = std::max(high[a], records_[i].p[a]);
    }
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [&](size_t i) { return records_.begin() + i; };
  std::nth_element(
      at(begin), at(middle), at(end),
      [axis](const CausticRecord& a, const CausticRecord& b) { return a.p[axis] < b.p[axis]; });
  axes_[middle] = static_cast<uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

bool ForecastMap::is_sound() const {
  return axes_.size() == records_.size() &&
         std::ranges::all_of(axes_, [](uint8_t axis) { return axis < 3; });
}

struct ForecastMap::Nearest {
  struct Entry {
    float distance_squared;
    uint32_t record;
    bool operator<(const Entry& o) const { return distance_squared < o.distance_squared; }
  };
  Vec3f p;
  std::array<Entry, ForecastLobes::kMaxLobes> found{};  ///< a heap, the furthest first
  size_t count = 0;

  float reach_squared() const {
    return count < found.size() ? kInfinity : found[0].distance_squared;
  }
  void offer(uint32_t record, float distance_squared) {
    if (!(distance_squared < reach_squared())) return;
    const auto begin = found.begin();
    if (count == found.size()) std::pop_heap(begin, begin + count--);
    found[count++] = {distance_squared, record};
    std::push_heap(begin, begin + count);
  }
};

void ForecastMap::search(size_t begin, size_t end, Nearest& nearest) const {
  if (begin >= end) return;
  const size_t middle = begin + (end - begin) / 2;
  const int axis = axes_[middle];
  const float beyond = nearest.p[axis] - records_[middle].p[axis];
  if (beyond < 0.0f)
    search(begin, middle, nearest);
  else
    search(middle + 1, end, nearest);
  nearest.offer(static_cast<uint32_t>(middle), length_squared(records_[middle].p - nearest.p));
  if (!(sqr(beyond) < nearest.reach_squared())) return;
  if (beyond < 0.0f)
    search(middle + 1, end, nearest);
  else
    search(begin, middle, nearest);
}

ForecastLobes ForecastMap::lobes_at(const Vec3f& p) const {
  ForecastLobes lobes;
  if (!foretells()) return lobes;
  Nearest nearest;
  nearest.p = p;
  search(0, records_.size(), nearest);
  const float reach = std::sqrt(nearest.reach_squared());
  std::array<Vec3f, ForecastLobes::kMaxLobes> axes;
  std::array<float, ForecastLobes::kMaxLobes> widths;
  size_t count = 0;
  for (const Nearest::Entry& entry : nearest.found) {
    const Vec3f way = records_[entry.record].caster - p;
    const float distance = length(way);
    if (!(reach < kWidest * distance)) continue;
    axes[count] = way / distance;
    widths[count++] = kWidthOfReach * reach / distance;
  }
  for (size_t i = 0; i < count; ++i) {
    const float gap = gap_beside(std::span(axes).first(count), i);
    lobes.add(axes[i], std::max(widths[i], std::min(gap, kWidest)));
  }
  return lobes;
}

}  // namespace nephroid
