// Lamps are often rectangles that a modelling program cut in two triangles. As one patch they are
// sampled by solid angle as a whole, which halves the number of lights and their noise. Who calls
// it: the scene builder, for meshes that emit. It must not know lights.
#pragma once

#include "input/mesh_data.h"

namespace nephroid {

/// Turns each pair of successive triangles (a b c)(a c d) that makes a planar rectangle, with
/// texture coordinates that are affine over it and one normal for all corners, into a quad a b c d
/// in ring order. Everything else stays as it is; meshes without texture coordinates or with face
/// indices are not touched.
MeshData join_rectangles(MeshData mesh);

}  // namespace nephroid
