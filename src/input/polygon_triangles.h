// Cuts polygons into triangles by ear clipping (G. H. Meisters, "Polygons have ears", 1975) in the
// plane of the polygon's Newell normal. It must not know files and meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// Maximum number of a polygon's corners; the time grows with its square.
inline constexpr size_t kMaxPolygonCorners = 16384;

/// Triangles of a simple, nearly planar polygon, convex or not. `corners` are n finite positions in
/// ring order. The result has n - 2 triples of indices into them, in the polygon's winding. If the
/// polygon has area, all corners are used. Coinciding corners may give triangles without area. A
/// polygon that crosses itself also gets n - 2 triangles. Empty for n < 3.
std::vector<uint32_t> triangulate_polygon(std::span<const Vec3f> corners);

}  // namespace nephroid
