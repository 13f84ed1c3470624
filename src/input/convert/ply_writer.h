// Meshes as PLY files. It must not know scenes.
#pragma once

#include <string>

#include "input/mesh_data.h"

namespace nephroid {

/// A binary_little_endian PLY file that read_ply reads as the same mesh. Tangents are not written.
std::string ply_bytes(const MeshData& mesh);

}  // namespace nephroid
