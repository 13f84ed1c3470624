// A plane rectangle as lamps ask for it: points of it uniform by solid angle or by area, from data
// that lie side by side. Who calls it: the meshes of bilinear patches, and area lights,
// which keep their own. It must not know meshes.
#pragma once

#include <optional>

#include "scene/shape/bilinear_patch.h"
#include "scene/shape/shape.h"
#include "scene/shape/spherical_rectangle.h"

namespace nephroid {

/// The part of a point's error that is the same all over the patch: what was lost in double, and
/// the extent, which stands for the rounding of a distance to the patch, also along axes on which
/// all coordinates are zero; flat patches are traced in float.
Vec3f error_of_patch(const BilinearPatch& patch);

/// The point `q` of a patch, rounded to float, with all of its error.
void set_patch_point(const Vec3d& q, const Vec3f& patch_error, Vec3f* p, Vec3f* p_error);

class PlaneRectangle {
 public:
  /// Of a patch that is_rectangle(), with the unit normal of its outside at the centre.
  PlaneRectangle(const BilinearPatch& patch, const Vec3f& normal);

  /// As of Shape. (u, v) of a sample are those of the patch. Densities are those of a true
  /// rectangle, from which the patch differs by 1e-4 at most.
  ShapeSample sample_area(const Vec2f& u) const;
  std::optional<ShapeSample> sample_towards(const Vec3f& from, const Vec2f& u) const;
  float pdf_towards(const Vec3f& from, const Vec3f& p, const Vec3f& ng) const;

 private:
  ShapeSample sample_at(const Vec2f& uv, double pdf) const;

  RectangleFrame frame_;
  Vec3f p00_, p10_, p01_, p11_;  ///< of the patch, whose points are those of hits
  Vec3f error_, normal_;
  double area_;
};

}  // namespace nephroid
