// A tree over lights that are somewhere: chooses one in proportion to a bound of what it may send to a
// point, in logarithmic time (Conty Estevez & Kulla 2018; pbrt-v4 section 12.6.3).
// Who calls it: light_sampler.cpp. It must not know what kinds of lights there are.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/light/light_sampler.h"

namespace nephroid {

class LightTree {
 public:
  /// `lights` are pairs of a light's number and its bounds; lights of no power are left out.
  explicit LightTree(const std::vector<std::pair<int, LightBounds>>& lights, int light_count);

  bool empty() const { return nodes_.empty(); }
  /// `u` in [0,1). Empty if no light can reach the point.
  std::optional<LightChoice> sample(const Vec3f& p, const Vec3f& n, float u) const;
  /// Probability with which sample() returns `light`.
  float pmf(const Vec3f& p, const Vec3f& n, int light) const;

 private:
  struct Node {
    Vec3f center, axis;
    Vec3f min, max;
    float radius2 = 0;  ///< squared, of the bounding sphere
    float power = 0, cos_o = -1, sin_o = 0, cos_e = 0;
    bool two_sided = false, leaf = false;
    int child = 0;  ///< second child (the first follows its parent), or the light's number in a leaf
  };
  struct Item {
    int light;
    LightBounds bounds;
  };

  int build(std::vector<Item>& items, size_t begin, size_t end, uint64_t trail, int depth);
  static Node make_node(const LightBounds& bounds);
  static float importance(const Node& node, const Vec3f& p, const Vec3f& n);

  std::vector<Node> nodes_;
  std::vector<uint64_t> trails_;  ///< by light: the turns from the root to its leaf, lowest bit first
  std::vector<int8_t> depths_;    ///< by light: -1 if it is not in the tree
};

/// Smallest bounds that hold both.
LightBounds unite(const LightBounds& a, const LightBounds& b);

}  // namespace nephroid
