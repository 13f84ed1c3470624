#include "photon/start_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace nephroid {
namespace {

using Crowd = StartTree::Crowd;

constexpr int kMaxDepth = 10;
constexpr size_t kFewStarts = 8;
/// What a crowd more costs, over the cost of all starts together, so that there are few.
constexpr double kPrice = 0.003;

class Splitter {
 public:
  Splitter(std::span<const UsefulStart> starts, std::vector<uint32_t>& order)
      : starts_(starts), order_(order) {}

  struct Split {
    std::vector<Crowd> leaves, inner;
    double cost = 0;
  };

  Crowd crowd(size_t begin, size_t end) const {
    Crowd c{begin, end, {}, 0};
    for (size_t i = begin; i < end; ++i) add(c, i);
    return c;
  }

  /// From the leaves upwards, parts are kept where they cost less than the whole.
  Split best_split(const Crowd& c, double price, int depth) {
    Split whole{{c}, {}, c.cost() + price};
    if (depth == kMaxDepth || c.end - c.begin < 2 * kFewStarts) return whole;
    const size_t middle = cut(c);
    Split parts = best_split(crowd(c.begin, middle), price, depth + 1);
    const Split others = best_split(crowd(middle, c.end), price, depth + 1);
    parts.cost += others.cost;
    if (parts.cost >= whole.cost) return whole;
    parts.leaves.insert(parts.leaves.end(), others.leaves.begin(), others.leaves.end());
    parts.inner.insert(parts.inner.end(), others.inner.begin(), others.inner.end());
    parts.inner.push_back(c);
    return parts;
  }

 private:
  void add(Crowd& c, size_t i) const {
    const UsefulStart& start = starts_[order_[i]];
    c.bounds.extendBy(start.first_hit);
    c.weight += double{start.weight};
  }
  double grown(Crowd& c, size_t i) const {
    add(c, i);
    return c.cost();
  }

  void sort(const Crowd& c, int axis) {
    std::sort(order_.begin() + c.begin, order_.begin() + c.end, [&](uint32_t a, uint32_t b) {
      const float x = starts_[a].first_hit[axis], y = starts_[b].first_hit[axis];
      return x != y ? x < y : a < b;
    });
  }

  /// The cut in two that costs least; leaves the starts in its order.
  size_t cut(const Crowd& c) {
    struct {
      int axis = -1;
      size_t middle = 0;
      double cost = 0;
    } best;
    std::vector<double> below(c.end - c.begin);
    for (int axis = 0; axis < 3; ++axis) {
      sort(c, axis);
      Crowd side;
      for (size_t i = 0; i < below.size(); ++i) below[i] = grown(side, c.begin + i);
      side = {};
      for (size_t i = below.size() - 1; i > 0; --i) {
        const double cost = below[i - 1] + grown(side, c.begin + i);
        if (best.axis < 0 || cost < best.cost) best = {axis, c.begin + i, cost};
      }
    }
    sort(c, best.axis);
    return best.middle;
  }

  std::span<const UsefulStart> starts_;
  std::vector<uint32_t>& order_;
};

}  // namespace

StartTree::StartTree(std::span<const UsefulStart> starts, size_t most) : order_(starts.size()) {
  std::iota(order_.begin(), order_.end(), uint32_t{0});
  Splitter splitter(starts, order_);
  const Crowd all = splitter.crowd(0, order_.size());
  // Dearer until there are few enough.
  for (double price = kPrice;; price *= 2) {
    Splitter::Split split = splitter.best_split(all, price * all.cost(), 0);
    if (split.leaves.size() > most) continue;
    leaves_ = std::move(split.leaves);
    inner_ = std::move(split.inner);
    return;
  }
}

}  // namespace nephroid
