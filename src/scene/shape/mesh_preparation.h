// What is done to a mesh between the file and the shape: it is checked, and its quads are cut or
// kept. Who calls it: the scene builder. It must not know how meshes are traced or sampled.
#pragma once

#include <string>

#include "core/errors.h"
#include "input/mesh_data.h"

namespace nephroid {

/// Throws SceneError if an index is out of range, a position, normal or texture coordinate is not
/// finite, a position is out of reach (kLargestCoordinate), an array does not fit the number of
/// vertices or faces, or a face is incomplete. Faces without area are removed (with their
/// face_indices), with one warning that counts them; `what` names the mesh in messages. Quads may
/// be in ring or in patch order. face_indices, if there are any, count the triangles first and then
/// the quads.
void validate_mesh(MeshData& mesh, const SourceLocation& where, const std::string& what,
                   Diagnostics& diagnostics);

/// Normals that are not finite become 0, which leaves a face its own normal there; one warning
/// counts those of vertices that a face uses. Indices out of range are left to validate_mesh.
void zero_bad_normals(MeshData& mesh, const SourceLocation& where, const std::string& what,
                      Diagnostics& diagnostics);

/// Turns the normals around: pbrt does so with the normals of a mesh under ReverseOrientation,
/// before it asks which side the faces show.
void reverse_normals(MeshData& mesh);

/// The mesh with each quad (ring order) cut into two triangles behind the triangles it had.
MeshData split_quads(MeshData mesh);

/// The triangles of the mesh alone, with their face_indices.
MeshData triangles_of(const MeshData& mesh);

/// The quads of the mesh alone, from the ring order v0 v1 v2 v3 of PLY files into the patch order
/// p00 p10 p01 p11 = v0 v1 v3 v2 that make_bilinear_mesh wants (as pbrt-v4 does).
MeshData quads_of(const MeshData& mesh);

}  // namespace nephroid
