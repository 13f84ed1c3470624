// How much of the light that a light sampler expects arrives where: means in cells, learned from
// samples of direct light. It must not know lights or how samples are made. See light_survey.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// What one sample says about one slot: a light, a group of lights, or a node of a light tree.
struct SlotSample {
  uint32_t slot = 0;
  float value = 0;
};

/// Samples at a point, in any number.
struct SurveyedPoint {
  Vec3f p;
  std::vector<SlotSample> samples;
};

/// Part of the choices that ignores what was learned, since what a cell has not seen may be there.
inline constexpr double kUnlearned = 0.1;
/// [D5] Probability of a thing of `importance`, of which `share` arrives, among things whose sums
/// are `all` and (importance times share) `all_that_arrives`. `all` is above 0.
inline double learned_probability(double importance, double share, double all,
                                  double all_that_arrives) {
  const double plain = importance / all;
  if (!(all_that_arrives > 0)) return plain;
  return kUnlearned * plain + (1 - kUnlearned) * (importance * share / all_that_arrives);
}

class LightVisibility {
 public:
  /// Nothing is known; empty() is true.
  LightVisibility() = default;
  LightVisibility(std::span<const SurveyedPoint> points, size_t slots);

  bool empty() const { return nodes_.empty(); }
  /// [slot] Mean of the samples in the cell around `p`.
  const float* at(const Vec3f& p) const {
    const Node* node = nodes_.data();
    while (node->axis != kLeaf) node = &nodes_[node->child + (p[node->axis] < node->split ? 0 : 1)];
    return &means_[node->child];
  }

 private:
  static constexpr int kLeaf = 3;
  struct Node {
    int axis = kLeaf;
    float split = 0;
    uint32_t child = 0;  ///< first of two adjacent children; of a leaf, the index of its means
  };
  class Builder;

  std::vector<Node> nodes_;
  std::vector<float> means_;
};

}  // namespace nephroid
