#include "scene/light/light_visibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid {

namespace {

/// Cells with twice as many points are divided (ADR 43: smaller ones follow shadows more closely,
/// but are noisier).
constexpr size_t kPointsOfCell = 64;
/// The mean of the cell around counts like so many samples of a cell's own.
constexpr double kSamplesOfParent = 20;

}  // namespace

class LightVisibility::Builder {
 public:
  Builder(LightVisibility& result, std::span<const SurveyedPoint> points, size_t slots)
      : result_(result), points_(points), slots_(slots), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    result_.nodes_.emplace_back();
    build(0, order_, std::vector<double>(slots_, kNeverSampled), 0);
  }

 private:
  static constexpr double kNeverSampled = -1;

  /// [slot] Means over points and over what is known of the cell around.
  std::vector<double> means_of(std::span<const uint32_t> points, const std::vector<double>& around,
                               double samples_around) const {
    std::vector<double> sums(slots_), samples(slots_, samples_around);
    for (size_t slot = 0; slot < slots_; ++slot) sums[slot] = samples_around * around[slot];
    for (const uint32_t i : points)
      for (const SlotSample& s : points_[i].samples) {
        if (!std::isfinite(s.value)) continue;
        sums[s.slot] += s.value;
        samples[s.slot] += 1;
      }
    for (size_t slot = 0; slot < slots_; ++slot)
      sums[slot] = samples[slot] > 0 ? sums[slot] / samples[slot] : kNeverSampled;
    return sums;
  }

  void build(uint32_t node, std::span<uint32_t> points, const std::vector<double>& around,
             double samples_around) {
    const std::vector<double> means = means_of(points, around, samples_around);
    const Cut cut = cut_of(points);
    if (cut.axis == kLeaf) {
      result_.nodes_[node] = {kLeaf, 0, static_cast<uint32_t>(result_.means_.size())};
      constexpr double kMost = 1e30;  // products with importances stay finite
      for (const double mean : means)
        result_.means_.push_back(static_cast<float>(std::min(mean, kMost)));
      return;
    }
    // In their order, so that sums are the same with every standard library.
    const auto second = std::stable_partition(points.begin(), points.end(), [&](uint32_t i) {
      return points_[i].p[cut.axis] < cut.split;
    });
    const auto half = static_cast<size_t>(second - points.begin());
    const auto child = static_cast<uint32_t>(result_.nodes_.size());
    result_.nodes_.resize(result_.nodes_.size() + 2);
    result_.nodes_[node] = {cut.axis, cut.split, child};
    build(child, points.first(half), means, kSamplesOfParent);
    build(child + 1, points.subspan(half), means, kSamplesOfParent);
  }

  struct Cut {
    int axis = kLeaf;
    float split = 0;  ///< points below it come first; some do, some do not
  };
  /// At the median of the longest axis.
  Cut cut_of(std::span<const uint32_t> points) const {
    if (points.size() < 2 * kPointsOfCell) return {};
    Bounds3f bounds;
    for (const uint32_t i : points) bounds.extendBy(points_[i].p);
    const Vec3f size = bounds.max - bounds.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (!(size[axis] > 0)) return {};
    std::vector<float> places;
    places.reserve(points.size());
    for (const uint32_t i : points) places.push_back(points_[i].p[axis]);
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
    std::ranges::nth_element(places, middle);
    if (*middle > bounds.min[axis]) return {axis, *middle};
    // More than half are at the lower end.
    float next = bounds.max[axis];
    for (const float x : places)
      if (x > bounds.min[axis]) next = std::min(next, x);
    return {axis, next};
  }

  LightVisibility& result_;
  const std::span<const SurveyedPoint> points_;
  const size_t slots_;
  std::vector<uint32_t> order_;
};

LightVisibility::LightVisibility(std::span<const SurveyedPoint> points, size_t slots) {
  if (!points.empty()) Builder(*this, points, slots);
}

}  // namespace nephroid
