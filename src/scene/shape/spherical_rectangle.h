// The part of the unit sphere around a point that a rectangle in space covers: its solid angle and
// uniform points in it. Who calls it: the bilinear patches. It must not know meshes.
// C. Urena, M. Fajardo, A. King, "An Area-Preserving Parametrization for Spherical Rectangles",
// EGSR 2013.
#pragma once

#include "core/math.h"

namespace nephroid {

class SphericalRectangle {
 public:
  /// A corner and the two orthogonal edges that leave it, as seen from the point `from`.
  SphericalRectangle(const Vec3d& from, const Vec3d& corner, const Vec3d& edge_x,
                     const Vec3d& edge_y);

  /// In steradians, 0..2 pi; 0 if the rectangle is seen edge-on.
  double solid_angle() const { return solid_angle_; }
  /// The point of the rectangle, in fractions of the edges, that is uniform in solid angle.
  Vec2f sample(const Vec2f& u) const;

 private:
  double x0_, x1_, y0_, y1_;  ///< in the rectangle's own axes, `from` at the origin
  double z0_;                 ///< distance of its plane, negative
  double k_ = 0;              ///< angle at which the parametrization starts
  double solid_angle_ = 0;
};

}  // namespace nephroid
