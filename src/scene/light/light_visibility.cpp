#include "scene/light/light_visibility.h"

#include <algorithm>
#include <numeric>

namespace nephroid {

namespace {

/// Cells have at least so many points (ADR 43: fewer follow shadows more closely, but are noisier).
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
    build(0, order_, std::vector<double>(slots_), 0);
  }

 private:
  /// [slot] Means over points and over what is known of the cell around.
  std::vector<double> means_of(std::span<const uint32_t> points, const std::vector<double>& around,
                               double samples_around) const {
    std::vector<double> sums(slots_), samples(slots_, samples_around);
    for (size_t slot = 0; slot < slots_; ++slot) sums[slot] = samples_around * around[slot];
    for (const uint32_t i : points)
      for (const SlotSample& s : points_[i].samples) {
        sums[s.slot] += s.value;
        samples[s.slot] += 1;
      }
    for (size_t slot = 0; slot < slots_; ++slot)
      if (samples[slot] > 0) sums[slot] /= samples[slot];
    return sums;
  }

  void build(uint32_t node, std::span<uint32_t> points, const std::vector<double>& around,
             double samples_around) {
    const std::vector<double> means = means_of(points, around, samples_around);
    Bounds3f bounds;
    for (const uint32_t i : points) bounds.extendBy(points_[i].p);
    const Vec3f size = bounds.max - bounds.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (points.size() < 2 * kPointsOfCell || !(size[axis] > 0)) {
      result_.nodes_[node] = {kLeaf, 0, static_cast<uint32_t>(result_.means_.size())};
      for (const double mean : means) result_.means_.push_back(static_cast<float>(mean));
      return;
    }
    const size_t half = points.size() / 2;
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(half);
    // Points of equal coordinates are in the order of their numbers, so that the cells are the same
    // with every standard library.
    std::ranges::nth_element(points, middle, [&](uint32_t a, uint32_t b) {
      const float x = points_[a].p[axis], y = points_[b].p[axis];
      return x != y ? x < y : a < b;
    });
    const auto child = static_cast<uint32_t>(result_.nodes_.size());
    result_.nodes_.resize(result_.nodes_.size() + 2);
    result_.nodes_[node] = {axis, points_[*middle].p[axis], child};
    build(child, points.first(half), means, kSamplesOfParent);
    build(child + 1, points.subspan(half), means, kSamplesOfParent);
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
