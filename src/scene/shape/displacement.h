// Displacement of meshes: refined until all edges are short, then moved along their normals. It
// must not know textures. Refinement: longest-edge bisection (Rivara 1984), as in pbrt-v4.
#pragma once

#include <functional>
#include <optional>

#include "core/math.h"
#include "input/mesh_data.h"

namespace nephroid {

/// Maximum number of triangles of a displaced mesh.
inline constexpr size_t kMaxDisplacedTriangles = 100'000'000;

struct Displacement {
  float edge_length = 1;      ///< upper bound of edge lengths in world space
  Transform object_to_world;  ///< transform in which edge lengths are measured
  /// Distance by which the surface moves along its unit normal at a point, in object space.
  std::function<float(const Vec3f& p, const Vec2f& uv)> height;
};

/// The displaced mesh: triangles only (quads are split), with new normals, the sum of the face
/// normals around a vertex. The input has texture coordinates, finite positions and valid indices.
/// Empty if the result would exceed `most_triangles` triangles or vertices, or has infinite edges.
std::optional<MeshData> displace_mesh(MeshData mesh, const Displacement& displacement,
                                      size_t most_triangles = kMaxDisplacedTriangles);

}  // namespace nephroid
