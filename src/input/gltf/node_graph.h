// The nodes of a glTF file with their transforms at a moment, and which of them the scene shows. It
// must not know what nodes carry.
#pragma once

#include <vector>

#include "input/gltf/animation.h"
#include "input/gltf/document.h"
#include "input/scene_description.h"

namespace nephroid::gltf {

class NodeGraph {
 public:
  /// Reads all nodes; `start` and `end` are the animations at both ends of the shutter. Throws
  /// SceneError if a node is below itself or below two nodes.
  NodeGraph(Document& document, const AnimationPose& start, const AnimationPose& end);

  size_t size() const { return parents_.size(); }
  /// Node to world at both ends of the shutter, for row vectors.
  const TransformDescription& world(size_t node) const { return worlds_[node]; }
  /// The nodes of the chosen scene, parents before children.
  const std::vector<size_t>& shown() const { return shown_; }

 private:
  void find_parents(Document& document);
  void find_worlds(Document& document, const AnimationPose& start, const AnimationPose& end);
  void find_shown(Document& document);

  static constexpr size_t kNone = static_cast<size_t>(-1);
  std::vector<size_t> parents_;
  std::vector<std::vector<size_t>> children_;
  std::vector<TransformDescription> worlds_;
  std::vector<size_t> shown_;
};

/// The matrix of a pose, for row vectors: first the scale, then the rotation, then the translation.
Mat44d matrix_of(const NodePose& pose);

/// The scene that is shown: the file's choice, else the first; empty if there is none.
std::optional<JsonValue> chosen_scene(Document& document);

}  // namespace nephroid::gltf
