// The two containers of glTF: JSON text alone (.gltf), and JSON text with a binary chunk (.glb). It
// must not know the JSON.
#pragma once

#include <string>
#include <string_view>

#include "core/errors.h"

namespace nephroid::gltf {

struct Container {
  std::string_view json;
  std::string_view binary;  ///< the binary chunk; empty if there is none
};

/// Splits the bytes of a file, to which the result refers. Throws SceneError at `file` for a
/// damaged GLB container.
Container read_container(std::string_view bytes, const SourceLocation& file);

}  // namespace nephroid::gltf
