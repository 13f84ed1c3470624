// A binary tree over the lights that have bounds; choosing one for a receiving point costs the
// depth of the tree. (Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive
// Tree Splitting"; without the splitting, as in pbrt-v4 section 12.6.3.) Who calls it:
// LightSampler. It must not know lights, only their bounds.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/light/light.h"

namespace nephroid {

/// What a node needs of its lights, ready for importance(): one of them or all below an inner node.
struct LightCluster {
  Vec3f center{0, 0, 0};  ///< of the sphere around the bounding box
  float radius2 = 0;
  Vec3f axis{0, 0, 1};
  float power = 0;
  float cos_o = -1, sin_o = 0, cos_e = 0;
  uint32_t two_sided = 0;
  float depth = std::numeric_limits<float>::infinity();

  LightCluster() = default;
  explicit LightCluster(const LightBounds& bounds);
  /// An estimate of what arrives at `p` with unit normal `n` (null: none), never 0 where light
  /// arrives.
  float importance(const Vec3f& p, const Vec3f& n) const;
};

class LightTree {
 public:
  struct Item {
    LightBounds bounds;
    int light = -1;
  };
  struct Choice {
    int light = -1;
    double probability = 0;
  };

  /// `light_count` is one more than the largest Item::light.
  LightTree(std::vector<Item> items, int light_count);

  bool empty() const { return nodes_.empty(); }
  /// A light for `u` in [0,1), with `probability` times the probability of the choice. Empty if no
  /// light can matter.
  std::optional<Choice> sample(const Vec3f& p, const Vec3f& n, double u, double probability) const;
  /// The probability of that choice; 0 for lights that are not in the tree.
  double pmf(const Vec3f& p, const Vec3f& n, int light, double probability) const;
  /// Inner nodes on the longest way down.
  int depth() const { return depth_; }

 private:
  static constexpr uint32_t kLeaf = 0x80000000u;
  struct Node {
    LightCluster cluster;
    uint32_t child = 0;  ///< first of two neighbours; or kLeaf | index of the light
  };
  struct Trail {
    uint64_t bits = 0;  ///< turns on the way down, the first in the lowest bit
    bool present = false;
  };

  LightBounds build(uint32_t node, std::vector<Item>& items, size_t begin, size_t end,
                    uint64_t trail, int depth);
  /// Probability of the first child; negative if neither can matter.
  double first_probability(const Node& node, const Vec3f& p, const Vec3f& n) const;

  std::vector<Node> nodes_;
  std::vector<Trail> trails_;
  int depth_ = 0;
};

/// Bounds of two groups of lights together. A group without power does not count.
LightBounds union_of(const LightBounds& a, const LightBounds& b);

}  // namespace nephroid
