// Animations at a moment: translations, rotations, scales and morph weights of nodes. It must not
// know the graph of nodes.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "input/gltf/document.h"

namespace nephroid::gltf {

struct NodePose {
  std::array<double, 3> translation{0, 0, 0};
  std::array<double, 4> rotation{0, 0, 0, 1};  ///< quaternion x, y, z, w
  std::array<double, 3> scale{1, 1, 1};
};

/// Properties that animations set, by node.
class AnimationPose {
 public:
  /// Evaluates all animations of the file at `time` in s. If two set the same property of a
  /// node, the first one counts, with a warning.
  AnimationPose(Document& document, double time);

  void apply(size_t node, NodePose& pose) const;
  /// True if an animation sets the translation, rotation or scale.
  bool moves(size_t node) const;
  /// Morph weights; nullptr if no animation sets them.
  const std::vector<float>* weights(size_t node) const;

 private:
  struct Animated {
    std::optional<std::vector<float>> translation, rotation, scale, weights;
  };
  void read_channel(Document& document, const JsonValue& channel,
                    const std::vector<JsonValue>& samplers, double time);

  std::map<size_t, Animated> nodes_;
};

}  // namespace nephroid::gltf
