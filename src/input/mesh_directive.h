// A mesh as the directive Shape "trianglemesh", and back. It must not know files.
#pragma once

#include <optional>

#include "input/mesh_data.h"
#include "input/scene_description.h"

namespace nephroid {

/// The directive of a mesh of triangles; quads are not taken.
DirectiveDescription mesh_directive(const MeshData& mesh, const SourceLocation& where);

/// The mesh of a directive, if it is a "trianglemesh" that a PLY file can hold: positions, normals,
/// one set of texture coordinates, faces, and counts and numbers that are right.
std::optional<MeshData> mesh_for_a_file(const DirectiveDescription& directive);

}  // namespace nephroid
