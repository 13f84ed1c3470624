// Preparation of a mesh between file and shape: it is checked, and its quads are split or kept. It
// must not know how meshes are traced or sampled.
#pragma once

#include <string>

#include "core/errors.h"
#include "input/mesh_data.h"

namespace nephroid {

/// Throws SceneError for indices out of range, positions, normals or texture coordinates that are
/// not finite, and positions out of reach (kLargestCoordinate). Also for incomplete faces, and
/// arrays that do not match the number of vertices or faces. Faces without area are removed (with
/// their face_indices), and one warning counts them. `what` names the mesh in messages. Quads can
/// be in ring or in patch order. face_indices, if any, list the triangles first and then the quads.
void validate_mesh(MeshData& mesh, const SourceLocation& where, const std::string& what,
                   Diagnostics& diagnostics);

/// Sets normals that are not finite to 0, so that a face uses its own normal there. One warning
/// counts those of used vertices. Indices out of range are left to validate_mesh.
void zero_bad_normals(MeshData& mesh, const SourceLocation& where, const std::string& what,
                      Diagnostics& diagnostics);

/// Reverses the normals. pbrt does this under ReverseOrientation, before normals decide which side
/// of the faces is outside.
void reverse_normals(MeshData& mesh);

/// Splits each quad (ring order) into two triangles, appended to the existing triangles.
MeshData split_quads(MeshData mesh);

/// The triangles of the mesh only, with their face_indices.
MeshData triangles_of(const MeshData& mesh);

/// The quads of the mesh only. As in pbrt-v4, the ring order v0 v1 v2 v3 of PLY files becomes the
/// patch order p00 p10 p01 p11 = v0 v1 v3 v2 of make_bilinear_mesh.
MeshData quads_of(const MeshData& mesh);

}  // namespace nephroid
