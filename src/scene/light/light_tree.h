// A binary tree over the bounded lights: choosing a light for a receiving point costs the depth of
// the tree. It must not know lights, only their bounds. Paper: Conty Estevez & Kulla 2018,
// Importance Sampling of Many Lights with Adaptive Tree Splitting; without splitting, as in pbrt-v4
// section 12.6.3.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/light/equiangular.h"
#include "scene/light/light.h"
#include "scene/light/light_visibility.h"

namespace nephroid {

/// Lights of a node, ready for importance(): one light, or all below an inner node.
struct LightCluster {
  Vec3f center{0, 0, 0};  ///< centre of the sphere around the bounding box
  float radius2 = 0;
  Vec3f axis{0, 0, 1};
  float power = 0;
  float cos_o = -1, sin_o = 0, cos_e = 0;
  uint32_t two_sided = 0;
  float depth = std::numeric_limits<float>::infinity();

  LightCluster() = default;
  explicit LightCluster(const LightBounds& bounds);
  /// Estimates the light that arrives at `p` with unit normal `n` (null: none). Never 0 where light
  /// arrives.
  float importance(const Vec3f& p, const Vec3f& n) const;
  /// Distances along a ray of unit direction that see the lights well.
  Equiangular along(const Ray& ray, float t_max) const;
  /// Estimates the light that arrives along a ray, summed over its length.
  float importance_along(const Ray& ray, float t_max) const {
    constexpr float kMost = 1e30f;  // sums of two stay finite
    return std::min(power * along(ray, t_max).importance(), kMost);
  }
};

class LightTree {
 public:
  struct Item {
    LightBounds bounds;
    int light = -1;
  };
  struct Choice {
    int light = -1;
    ChoiceProbability probability;
  };
  /// What LightVisibility has learned for the slots at a point, or null.
  struct Learned {
    const float* shares = nullptr;
    bool follows = false;  ///< whether a sample follows it; its probabilities count in any case
  };
  /// A node with a slot on the way down to a light.
  struct Turn {
    uint32_t slot = 0;
    float importance = 0;
    double probability = 0;  ///< chance that a sample reaches this node
  };

  /// `light_count` is one more than the largest Item::light.
  LightTree(std::vector<Item> items, int light_count);

  bool empty() const { return nodes_.empty(); }
  /// Samples a light by `u` in [0,1). Empty if no light can contribute.
  std::optional<Choice> sample(const Vec3f& p, const Vec3f& n, double u,
                               const Learned& learned) const;
  /// The probabilities of that choice; 0 for lights that are not in the tree.
  ChoiceProbability pmf(const Vec3f& p, const Vec3f& n, int light, const float* shares) const;
  /// Number of nodes whose visibility can be learned: those of most power.
  uint32_t slot_count() const { return slot_count_; }
  struct Surveyed {
    int light = -1;
    double probability = 0;
  };
  /// Samples a light to learn from, without shares. Where nodes have slots, each child that can
  /// contribute is taken at least a quarter of the time. Adds the way down to `turns`. Empty if no
  /// light can contribute.
  std::optional<Surveyed> survey(const Vec3f& p, const Vec3f& n, double u,
                                 std::vector<Turn>& turns) const;
  /// True if sample_along() can return a light.
  bool shines_along(const Ray& ray, float t_max) const {
    return !nodes_.empty() && nodes_[0].cluster.importance_along(ray, t_max) > 0.0f;
  }
  /// The same for the light that arrives along a ray, with probability 1 for all lights together.
  std::optional<Choice> sample_along(const Ray& ray, float t_max, double u) const;
  double pmf_along(const Ray& ray, float t_max, int light) const;
  /// The cluster of a single light of the tree; null for other lights.
  const LightCluster* leaf(int light) const;
  /// Number of inner nodes on the longest path.
  int depth() const { return depth_; }

 private:
  static constexpr uint32_t kLeaf = 0x80000000u, kNoSlot = 0xffffffffu;
  struct Node {
    LightCluster cluster;
    uint32_t child = 0;       ///< first of two adjacent children; or kLeaf | index of the light
    uint32_t slot = kNoSlot;  ///< slot of the first child
  };
  struct Trail {
    uint64_t bits = 0;  ///< turns on the path down, the first in the lowest bit
    bool present = false;
  };

  bool contains(int light) const {
    return light >= 0 && light < static_cast<int>(trails_.size()) && trails_[light].present;
  }
  LightBounds build(uint32_t node, std::vector<Item>& items, size_t begin, size_t end,
                    uint64_t trail, int depth);
  void give_slots();
  /// Probabilities of the first child; `plain` is negative if neither child can contribute.
  /// `importance` is that of a cluster.
  template <class Importance>
  ChoiceProbability first_probability(const Node& node, const Importance& importance,
                                      const float* shares) const;
  template <class Importance>
  std::optional<Choice> sample(const Importance& importance, double u,
                               const Learned& learned) const;
  template <class Importance>
  ChoiceProbability pmf(const Importance& importance, int light, const float* shares) const;

  std::vector<Node> nodes_;
  std::vector<Trail> trails_;
  int depth_ = 0;
  uint32_t slot_count_ = 0;
};

/// Joint bounds of two groups of lights. A group without power is ignored.
LightBounds union_of(const LightBounds& a, const LightBounds& b);

}  // namespace nephroid
