// Reads Mitsuba's .serialized files: meshes compressed with zlib, one after the other, with a table
// of their places at the end. It must not know scenes. Format: Mitsuba 0.6 documentation, section
// 8.1.4, and that of Mitsuba 3.
#pragma once

#include <string_view>

#include "input/mesh_data.h"

namespace nephroid::mitsuba {

struct SerializedMesh {
  MeshData mesh;
  bool has_face_normals = false;  ///< the mesh shall look faceted
};

/// The mesh number `index` of a file in version 3 or 4. Memory is bounded by what the file
/// contains, not by what it claims. Throws SceneError at `where`.
SerializedMesh read_serialized(std::string_view bytes, int index, const SourceLocation& where);

}  // namespace nephroid::mitsuba
