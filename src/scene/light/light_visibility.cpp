#include "scene/light/light_visibility.h"

#include <algorithm>
#include <numeric>

namespace nephroid {

namespace {

/// Cells have at least so many points (ADR 43: fewer follow shadows more closely, but are noisier).
constexpr size_t kPointsOfCell = 64;
/// What the cell around knows of a slot counts like so many samples of a cell's own.
constexpr double kSamplesOfParent = 20;

}  // namespace

class LightVisibility::Builder {
 public:
  Builder(LightVisibility& result, std::span<const SurveyedPoint> points, size_t slots)
      : result_(result), points_(points), slots_(slots), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    const Sums all = sums_of(order_);
    std::vector<double> shares(slots_);
    for (size_t slot = 0; slot < slots_; ++slot)
      if (all.expected[slot] > 0) shares[slot] = all.arrived[slot] / all.expected[slot];
    result_.nodes_.emplace_back();
    build(0, order_, shares, all);
  }

 private:
  /// [slot] Sums over points.
  struct Sums {
    explicit Sums(size_t slots) : arrived(slots), expected(slots), samples(slots) {}
    std::vector<double> arrived, expected, samples;
  };

  Sums sums_of(std::span<const uint32_t> points) const {
    Sums sums(slots_);
    for (const uint32_t i : points)
      for (const SlotSample& s : points_[i].samples) {
        sums.arrived[s.slot] += s.arrived;
        sums.expected[s.slot] += s.expected;
        sums.samples[s.slot] += 1;
      }
    return sums;
  }

  /// Shares of a half of the points of a cell with `sums` and `shares`.
  std::vector<double> shares_of_half(const Sums& of_half, const Sums& sums,
                                     const std::vector<double>& shares) const {
    std::vector<double> found = shares;
    for (size_t slot = 0; slot < slots_; ++slot) {
      if (!(sums.samples[slot] > 0)) continue;
      const double prior = kSamplesOfParent * sums.expected[slot] / sums.samples[slot];
      const double all = of_half.expected[slot] + prior;
      if (all > 0) found[slot] = (of_half.arrived[slot] + prior * shares[slot]) / all;
    }
    return found;
  }

  void build(uint32_t node, std::span<uint32_t> points, const std::vector<double>& shares,
             const Sums& sums) {
    Bounds3f bounds;
    for (const uint32_t i : points) bounds.extendBy(points_[i].p);
    const Vec3f size = bounds.max - bounds.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (points.size() < 2 * kPointsOfCell || !(size[axis] > 0)) {
      result_.nodes_[node] = {kLeaf, 0, static_cast<uint32_t>(result_.shares_.size())};
      for (const double share : shares) result_.shares_.push_back(static_cast<float>(share));
      return;
    }
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    // Points of equal coordinates are in the order of their numbers, so that the cells are the same
    // with every standard library.
    std::ranges::nth_element(points, middle, [&](uint32_t a, uint32_t b) {
      const float x = points_[a].p[axis], y = points_[b].p[axis];
      return x != y ? x < y : a < b;
    });
    const float split = points_[*middle].p[axis];
    const auto child = static_cast<uint32_t>(result_.nodes_.size());
    result_.nodes_.resize(result_.nodes_.size() + 2);
    result_.nodes_[node] = {axis, split, child};
    const size_t first = points.size() / 2;
    const auto build_half = [&](uint32_t half, std::span<uint32_t> of_half) {
      const Sums sums_of_half = sums_of(of_half);
      build(half, of_half, shares_of_half(sums_of_half, sums, shares), sums_of_half);
    };
    build_half(child, points.first(first));
    build_half(child + 1, points.subspan(first));
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
