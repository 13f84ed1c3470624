#include "photon/start_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace nephroid {
namespace {

using Crowd = StartTree::Crowd;

constexpr int kMaxDepth = 10;
constexpr size_t kFewStarts = 8;
/// Price of each crowd, over the cost of all starts in one; it keeps the crowds few.
constexpr double kPrice = 0.003;

/// All cuts in two, down to the smallest parts. Starts are sorted once along each axis, and a cut
/// keeps their order in both parts. So a level of the tree takes linear time (Wald & Havran 2006).
class CutTree {
 public:
  /// Rearranges `order` to that of the leaves, from left to right.
  CutTree(std::span<const UsefulStart> starts, std::vector<uint32_t>& order)
      : starts_(starts), order_(order), is_below_(starts.size()), other_(starts.size()) {
    for (int axis = 0; axis < 3; ++axis) {
      by_axis_[axis] = order;
      std::sort(by_axis_[axis].begin(), by_axis_[axis].end(), [&](uint32_t i, uint32_t j) {
        const float x = starts_[i].first_hit[axis], y = starts_[j].first_hit[axis];
        return x != y ? x < y : i < j;
      });
    }
    build(crowd(order, 0, order.size()), 0, order);
  }

  struct Split {
    std::vector<Crowd> leaves, inner;
    double cost = 0;
  };
  const Crowd& all() const { return nodes_.front().crowd; }
  /// Keeps two parts instead of their whole where they cost less, from the leaves upwards.
  Split best_split(double price, size_t node = 0) const {
    const Node& n = nodes_[node];
    Split whole{{n.crowd}, {}, n.crowd.cost() + price};
    if (n.parts[0] == 0) return whole;
    Split parts = best_split(price, n.parts[0]);
    const Split others = best_split(price, n.parts[1]);
    parts.cost += others.cost;
    if (parts.cost >= whole.cost) return whole;
    parts.leaves.insert(parts.leaves.end(), others.leaves.begin(), others.leaves.end());
    parts.inner.insert(parts.inner.end(), others.inner.begin(), others.inner.end());
    parts.inner.push_back(n.crowd);
    return parts;
  }

 private:
  struct Node {
    Crowd crowd;
    size_t parts[2] = {0, 0};  ///< 0: not cut
  };
  struct Cut {
    int axis = -1;
    size_t middle = 0;
    double cost = 0;
  };

  void add(Crowd& c, uint32_t start) const {
    c.bounds.extendBy(starts_[start].first_hit);
    c.weight += double{starts_[start].weight};
  }
  double grown(Crowd& c, uint32_t start) const {
    add(c, start);
    return c.cost();
  }
  Crowd crowd(const std::vector<uint32_t>& order, size_t begin, size_t end) const {
    Crowd c{begin, end, {}, 0};
    for (size_t i = begin; i < end; ++i) add(c, order[i]);
    return c;
  }

  /// Builds the node of a crowd; `order` has its starts as the cut above left them.
  size_t build(const Crowd& c, int depth, const std::vector<uint32_t>& order) {
    const size_t node = nodes_.size();
    nodes_.push_back({c});
    if (depth == kMaxDepth || c.end - c.begin < 2 * kFewStarts) {
      if (&order != &order_)
        std::copy(order.begin() + c.begin, order.begin() + c.end, order_.begin() + c.begin);
      return node;
    }
    const Cut cut = best_cut(c);
    divide(c, cut);
    const std::vector<uint32_t>& sorted = by_axis_[cut.axis];
    const Crowd below = crowd(sorted, c.begin, cut.middle),
                above = crowd(sorted, cut.middle, c.end);
    const size_t left = build(below, depth + 1, sorted);
    const size_t right = build(above, depth + 1, sorted);
    nodes_[node].parts[0] = left;
    nodes_[node].parts[1] = right;
    return node;
  }

  /// The cut of least cost along any axis.
  Cut best_cut(const Crowd& c) {
    Cut best;
    cost_below_.resize(c.end - c.begin);
    for (int axis = 0; axis < 3; ++axis) {
      const uint32_t* sorted = by_axis_[axis].data() + c.begin;
      Crowd side;
      for (size_t i = 0; i < cost_below_.size(); ++i) cost_below_[i] = grown(side, sorted[i]);
      side = {};
      for (size_t i = cost_below_.size() - 1; i > 0; --i) {
        const double cost = cost_below_[i - 1] + grown(side, sorted[i]);
        if (best.axis < 0 || cost < best.cost) best = {axis, c.begin + i, cost};
      }
    }
    return best;
  }

  /// Moves the starts below the cut before the others, in a stable order along each axis.
  void divide(const Crowd& c, const Cut& cut) {
    for (size_t i = c.begin; i < c.end; ++i) is_below_[by_axis_[cut.axis][i]] = i < cut.middle;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == cut.axis) continue;
      size_t below = c.begin, above = 0;
      for (size_t i = c.begin; i < c.end; ++i) {
        const uint32_t start = by_axis_[axis][i];
        if (is_below_[start])
          by_axis_[axis][below++] = start;
        else
          other_[above++] = start;
      }
      std::copy(other_.begin(), other_.begin() + above, by_axis_[axis].begin() + below);
    }
  }

  std::span<const UsefulStart> starts_;
  std::vector<uint32_t>& order_;
  std::array<std::vector<uint32_t>, 3> by_axis_;
  std::vector<uint8_t> is_below_;   ///< [start]: side of the last cut
  std::vector<uint32_t> other_;     ///< scratch of divide()
  std::vector<double> cost_below_;  ///< scratch of best_cut()
  std::vector<Node> nodes_;
};

}  // namespace

StartTree::StartTree(std::span<const UsefulStart> starts, size_t most) : order_(starts.size()) {
  std::iota(order_.begin(), order_.end(), uint32_t{0});
  const CutTree cuts(starts, order_);
  // The price is doubled until there are few enough leaves.
  for (double price = kPrice;; price *= 2) {
    CutTree::Split split = cuts.best_split(price * cuts.all().cost());
    if (split.leaves.size() > most) continue;
    leaves_ = std::move(split.leaves);
    inner_ = std::move(split.inner);
    return;
  }
}

}  // namespace nephroid
