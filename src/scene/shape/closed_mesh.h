// Detects closed meshes whose outside points into the enclosed volume. It must not know shapes or
// files.
#pragma once

#include <functional>

#include "input/mesh_data.h"

namespace nephroid {

/// The corners of a face in ring order, counter-clockwise seen from outside. A triangle repeats its
/// third corner.
struct OutsideRing {
  uint32_t corners[4] = {0, 0, 0, 0};
};

/// True if the mesh is closed and the enclosed volume is negative. Closed: each edge, by the
/// positions of its ends, belongs to two faces that agree on the outside.
bool is_closed_inside_out(const std::vector<Vec3f>& positions, size_t faces,
                          const std::function<OutsideRing(size_t face)>& ring_of);

}  // namespace nephroid
