// EXT_meshopt_compression: buffer views that the meshoptimizer library has packed. It must not know
// what the elements mean.
#pragma once

#include <cstddef>
#include <vector>

#include "input/gltf/json_value.h"

namespace nephroid::gltf {

class Document;

/// The bytes of a buffer view. Throws SceneError at the extension if they are damaged.
std::vector<std::byte> decompress_meshopt(Document& document, const JsonValue& extension);

}  // namespace nephroid::gltf
