// Cameras of nodes: the chosen one becomes the scene's, with a film of its shape.
#pragma once

#include "input/gltf/node_graph.h"

namespace nephroid::gltf {

/// Writes the camera that the options name, by name or index, else the first one shown. A file
/// without cameras leaves the scene without. Throws SceneError if there is no such camera.
void add_camera(Document& document, const NodeGraph& nodes, SceneDescription& scene);

}  // namespace nephroid::gltf
