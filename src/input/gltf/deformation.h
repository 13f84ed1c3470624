// Morph targets and skins: vertices of a mesh as a node shows them at a moment. It must not know
// materials.
#pragma once

#include <vector>

#include "input/gltf/node_graph.h"
#include "input/gltf/vertices.h"

namespace nephroid::gltf {

/// The morph weights of a node's mesh: animated, of the node, or of the mesh; empty if there are
/// none or all are 0.
std::vector<double> morph_weights(const JsonValue& node, size_t node_index, const JsonValue& mesh,
                                  const AnimationPose& animation);

/// Adds the weighted targets of a primitive to its positions, normals and tangents.
void morph(Document& document, const JsonValue& primitive, const std::vector<double>& weights,
           Vertices& vertices);

/// Moves vertices from the mesh to the world by the joints of a skin, at the start of the shutter.
/// Joints that mirror keep the outside of the mesh outside.
void skin(Document& document, const JsonValue& skin, AttributeSource& source,
          const JsonValue& primitive, const NodeGraph& nodes, Vertices& vertices);

}  // namespace nephroid::gltf
