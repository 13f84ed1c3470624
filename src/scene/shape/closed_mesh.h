// Tells whether a mesh is a closed surface whose outside points into what it encloses. It must not
// know shapes or files.
#pragma once

#include <functional>

#include "input/mesh_data.h"

namespace nephroid {

/// The corners of a face, in the ring order that is counter-clockwise seen from its outside. The
/// last one of a triangle is a copy of the third.
struct OutsideRing {
  uint32_t corners[4] = {0, 0, 0, 0};
};

/// True if the faces are closed (each edge, by the positions of its ends, belongs to two faces that
/// agree on the outside) and the volume inside of them is negative.
bool is_closed_inside_out(const std::vector<Vec3f>& positions, size_t faces,
                          const std::function<OutsideRing(size_t face)>& ring_of);

}  // namespace nephroid
