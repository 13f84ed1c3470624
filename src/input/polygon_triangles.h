// Cuts polygons into triangles. Knows nothing of files and meshes.
// Method: ear clipping (G. H. Meisters, "Polygons have ears", 1975) in the plane of the polygon's
// Newell normal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// The most corners that a polygon may have: the time grows with their square.
inline constexpr size_t kMaxPolygonCorners = 16384;

/// Triangles of a simple polygon, convex or not, nearly plane or plane: n - 2 triples of indices
/// into `corners` (finite positions in ring order, n of them) that wind as the polygon does. All
/// corners are used as long as the polygon has area; triangles without area are possible where
/// corners coincide. A polygon that crosses itself gets some n - 2 triangles. Empty for n < 3.
std::vector<uint32_t> triangulate_polygon(std::span<const Vec3f> corners);

}  // namespace nephroid
