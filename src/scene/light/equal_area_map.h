// The equal-area map between the unit square and the unit sphere that environment images use
// (Clarberg 2008, "Fast equal-area mapping of the (hemi)sphere using SIMD"; octahedral layout).
// Who calls it: image infinite lights. It must not know images.
#pragma once

#include "core/math.h"

namespace nephroid {

/// Unit vector of a point of [0,1]^2; areas are multiplied by 4 pi. The centre is +z, the corners
/// -z.
Vec3f equal_area_square_to_sphere(const Vec2f& square);
/// The inverse for a unit vector.
Vec2f equal_area_sphere_to_square(const Vec3f& direction);

}  // namespace nephroid
