// How much of the light that a light sampler expects arrives where: means in cells, learned from
// samples of direct light. It must not know lights or how samples are made. See light_survey.h.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// One sample of a slot: a light, a group of lights, or a node of a light tree.
struct SlotSample {
  uint32_t slot = 0;
  double value = 0;  ///< ignored if it is not finite; the light sampler says what it is
};

/// Samples at a point, in any number.
struct SurveyedPoint {
  Vec3f p;
  std::vector<SlotSample> samples;
};

/// Part of the choices that ignores what was learned: a light that no sample of a cell saw may
/// still shine there.
inline constexpr double kUnlearned = 0.1;

/// Both probabilities of one choice.
struct ChoiceProbability {
  double plain = 1;    ///< lights are chosen by importance
  double learned = 1;  ///< lights are chosen by importance times what was learned to arrive
  /// [D5] The probability if a part of the choices is plain.
  double mixed() const { return kUnlearned * plain + (1 - kUnlearned) * learned; }
  ChoiceProbability& operator*=(const ChoiceProbability& next) {
    plain *= next.plain;
    learned *= next.learned;
    return *this;
  }
};

class LightVisibility {
 public:
  /// Nothing is known; empty() is true.
  LightVisibility() = default;
  /// All samples are of slots below `slots`.
  LightVisibility(std::span<const SurveyedPoint> points, size_t slots);

  bool empty() const { return nodes_.empty(); }
  /// [slot] Mean of the samples in the cell around `p`, negative if no cell has a sample. Valid
  /// as long as this object. Not if empty().
  const float* at(const Vec3f& p) const {
    assert(!empty());
    const Node* node = nodes_.data();
    while (node->axis != kLeaf) node = &nodes_[node->child + (p[node->axis] < node->split ? 0 : 1)];
    return &means_[node->child];
  }
  /// Changes the means of each cell by `change(means)`.
  template <class Change>
  void for_each_cell(const Change& change) {
    for (const Node& node : nodes_)
      if (node.axis == kLeaf) change(&means_[node.child]);
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
