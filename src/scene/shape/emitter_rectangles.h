// Joins triangle pairs of emitters into rectangles: one patch is sampled by solid angle as a whole,
// which halves the number of lights and reduces noise. It must not know lights.
#pragma once

#include "input/mesh_data.h"

namespace nephroid {

/// Joins each pair of successive triangles (a b c)(a c d) that forms a planar rectangle into a quad
/// a b c d in ring order. Its texture coordinates must be affine, and its corners share one normal.
/// All else is unchanged, as are meshes without texture coordinates, or with face indices or
/// tangents.
MeshData join_rectangles(MeshData mesh);

}  // namespace nephroid
