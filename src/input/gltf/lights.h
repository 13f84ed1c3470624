// Lights: those of KHR_lights_punctual, and the image-based light of EXT_lights_image_based.
#pragma once

#include "input/gltf/node_graph.h"

namespace nephroid::gltf {

/// Adds the lights of all shown nodes and of the scene. One candela, one lux and one candela per
/// square metre are each one unit of the picture, as emission factors are.
void add_lights(Document& document, const NodeGraph& nodes, SceneDescription& scene);

}  // namespace nephroid::gltf
