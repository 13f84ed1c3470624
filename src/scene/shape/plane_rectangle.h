// A plane rectangle for light sampling: points uniform by solid angle or by area. Area lights keep
// their own copy, so that the data are contiguous in memory. It must not know meshes.
#pragma once

#include <optional>

#include "scene/shape/bilinear_patch.h"
#include "scene/shape/shape.h"
#include "scene/shape/spherical_rectangle.h"

namespace nephroid {

/// The part of a point's error that is constant over the patch: double rounding, and a share of the
/// extent. The latter covers rounded distances to the patch, since flat patches are traced in
/// float, also along axes on which all coordinates are zero.
Vec3f error_of_patch(const BilinearPatch& patch);

/// Rounds the patch point `q` to float and sets its full error.
void set_patch_point(const Vec3d& q, const Vec3f& patch_error, Vec3f* p, Vec3f* p_error);

class PlaneRectangle {
 public:
  /// Made from a patch that is_rectangle(), with the unit outside normal at its centre.
  PlaneRectangle(const BilinearPatch& patch, const Vec3f& normal);

  /// Same as in Shape. (u, v) of a sample are the patch's. Densities are those of an exact
  /// rectangle, from which the patch differs by at most 1e-4.
  ShapeSample sample_area(const Vec2f& u) const;
  std::optional<ShapeSample> sample_towards(const Vec3f& from, const Vec2f& u) const;
  float pdf_towards(const Vec3f& from, const Vec3f& p, const Vec3f& ng) const;

 private:
  ShapeSample sample_at(const Vec2f& uv, double pdf) const;

  RectangleFrame frame_;
  Vec3f p00_, p10_, p01_, p11_;  ///< corners of the patch; samples lie on the patch, like hits
  Vec3f error_, normal_;
  double area_;
};

}  // namespace nephroid
