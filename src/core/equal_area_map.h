// The equal-area map between the unit square and the unit sphere used by environment images
// (octahedral layout). It must not know images. Paper: Clarberg 2008, Fast Equal-Area Mapping of
// the (Hemi)Sphere using SIMD.
#pragma once

#include "core/math.h"

namespace nephroid {

/// Unit vector of a point of [0,1]^2. Areas are multiplied by 4 pi. The centre is +z, the corners
/// are -z.
Vec3f equal_area_square_to_sphere(const Vec2f& square);
/// The inverse of it, for a unit vector.
Vec2f equal_area_sphere_to_square(const Vec3f& direction);

}  // namespace nephroid
