// Displacement of meshes: refined until all edges are short, then moved along their normals.
// Who calls it: the table of shapes, for PLY meshes with a "displacement". It must not know
// textures. Refinement by bisection of longest edges (M. C. Rivara 1984), as pbrt-v4 does it.
#pragma once

#include <functional>
#include <optional>

#include "core/math.h"
#include "input/mesh_data.h"

namespace nephroid {

/// Triangles that a displaced mesh may have.
inline constexpr size_t kMaxDisplacedTriangles = 100'000'000;

struct Displacement {
  float edge_length = 1;      ///< all edges become shorter than this, in world space
  Transform object_to_world;  ///< for the lengths of edges
  /// How far the surface moves along its unit normal at a point, in object space.
  std::function<float(const Vec3f& p, const Vec2f& uv)> height;
};

/// The displaced mesh: triangles only (quads are cut into two), with new normals, the sum of those
/// of the faces around a vertex. The mesh has texture coordinates, its positions are finite and its
/// indices good. Empty if it would get more than `most_triangles` triangles, more vertices, or
/// edges of infinite length.
std::optional<MeshData> displace_mesh(MeshData mesh, const Displacement& displacement,
                                      size_t most_triangles = kMaxDisplacedTriangles);

}  // namespace nephroid
