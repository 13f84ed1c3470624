// Meshes of nodes: primitives become shapes "trianglemesh", and meshes that occur often become
// objects with instances. It must not know cameras and lights.
#pragma once

#include <map>
#include <set>

#include "input/gltf/deformation.h"
#include "input/gltf/materials.h"

namespace nephroid::gltf {

class Meshes {
 public:
  Meshes(Document& document, SceneDescription& scene, const NodeGraph& nodes,
         const AnimationPose& animation)
      : document_(document),
        scene_(scene),
        nodes_(nodes),
        animation_(animation),
        materials_(document, scene) {}

  /// Adds the meshes of all shown nodes.
  void add_all();

 private:
  /// A place where a mesh occurs.
  struct Use {
    size_t node;
    std::vector<TransformDescription> transforms;  ///< several with EXT_mesh_gpu_instancing
    std::vector<double> weights;                   ///< of morph targets
    std::optional<JsonValue> skin;
    std::string key;  ///< equal for uses with the same geometry; empty if there is only this one
  };

  Use use_of(size_t node, const JsonValue& description);
  std::vector<TransformDescription> transforms_of(size_t node, const JsonValue& description);
  void add(const Use& use, bool is_repeated);
  std::vector<ShapeDescription> make_shapes(const Use& use, const JsonValue& mesh);
  std::optional<ShapeDescription> make_shape(const Use& use, const JsonValue& primitive);

  Document& document_;
  SceneDescription& scene_;
  const NodeGraph& nodes_;
  const AnimationPose& animation_;
  Materials materials_;
};

}  // namespace nephroid::gltf
