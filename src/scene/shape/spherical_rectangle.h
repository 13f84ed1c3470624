// The part of the unit sphere around a point that a rectangle covers: its solid angle and uniform
// points in it. It must not know meshes. Paper: Urena, Fajardo & King, An Area-Preserving
// Parametrization for Spherical Rectangles, EGSR 2013.
#pragma once

#include "core/math.h"

namespace nephroid {

/// The axes of a rectangle, computed once per rectangle.
struct RectangleFrame {
  Vec3d corner, x, y, z;  ///< unit axes, x and y along the edges that leave the corner
  double length_x = 0, length_y = 0;

  RectangleFrame() = default;
  RectangleFrame(const Vec3d& corner_point, const Vec3d& edge_x, const Vec3d& edge_y)
      : corner(corner_point), length_x(edge_x.length()), length_y(edge_y.length()) {
    x = edge_x / length_x;
    y = edge_y / length_y;
    z = x.cross(y);
  }
};

class SphericalRectangle {
 public:
  /// The rectangle as seen from the point `from`.
  SphericalRectangle(const Vec3d& from, const RectangleFrame& rectangle);

  /// In steradians, 0 to 2 pi; 0 if the rectangle is seen edge-on.
  double solid_angle() const { return solid_angle_; }
  /// Samples a point uniform in solid angle, in fractions of the rectangle's edges.
  Vec2f sample(const Vec2f& u) const;

 private:
  double x0_, x1_, y0_, y1_;            ///< in the rectangle's own axes, `from` at the origin
  double z0_;                           ///< distance of its plane, negative
  double start_re_ = 1, start_im_ = 0;  ///< complex number whose argument is g2 + g3
  double solid_angle_ = 0;
};

}  // namespace nephroid
