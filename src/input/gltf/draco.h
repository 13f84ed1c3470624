// KHR_draco_mesh_compression: primitives that the Draco library has packed. It must not know what
// attributes mean.
#pragma once

#include <memory>

#include "input/gltf/vertices.h"

namespace nephroid::gltf {

/// Decodes a primitive. Attributes that are not packed come from the accessors. Throws SceneError
/// at the extension if the data are damaged.
std::unique_ptr<AttributeSource> open_draco(Document& document, const JsonValue& primitive,
                                            const JsonValue& extension);

}  // namespace nephroid::gltf
