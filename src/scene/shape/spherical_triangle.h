// The spherical triangle that a triangle covers on the unit sphere around a point: its solid angle
// and uniform directions in it. In double, so that solid angles down to 1e-6 sr keep precision.
// Papers: van Oosterom & Strackee 1983; Arvo 1995.
#pragma once

#include "core/math.h"

namespace nephroid {

class SphericalTriangle {
 public:
  /// The corners relative to the centre of the sphere, of any length but zero.
  SphericalTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c);

  /// In steradians, 0 to 2 pi; NaN if the centre is one of the corners.
  double solid_angle() const { return solid_angle_; }
  /// Samples a unit direction, uniform in solid angle, which must be above 0.
  Vec3d sample(const Vec2f& u) const;

 private:
  Vec3d a_, b_, c_;  ///< unit vectors
  double triple_;    ///< |a . (b x c)|
  double solid_angle_;
};

}  // namespace nephroid
