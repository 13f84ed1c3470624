// Distances along a ray towards a light near it, in equal angles as seen from the light (Kulla &
// Fajardo 2012, Importance Sampling Techniques for Path Tracing in Participating Media). It must
// not know media or lights, only their places.
#pragma once

#include "core/math.h"

namespace nephroid {

/// A light as seen from a ray: a sphere that shines in all directions, or a point that shines into
/// a cone.
struct LightPlace {
  Vec3f center{0, 0, 0};
  float radius2 = 0;
  Vec3f axis{0, 0, 1};  ///< axis of the cone, unit
  float cos_cone = -1;  ///< cosine of its half angle; not above 0: no cone
};

/// The piece of a ray that lies in the light's cone, with a density over it that falls with the
/// squared distance from the light's centre.
class Equiangular {
 public:
  Equiangular() = default;
  /// `ray` has unit direction and is cut off at `t_max`, which may be infinite.
  Equiangular(const Ray& ray, float t_max, const LightPlace& light);

  /// Angle of the piece, seen from the light, over the distance of the ray: the integral of 1/d^2
  /// over the piece, 1/length. 0 if the light does not shine on the ray.
  float importance() const { return static_cast<float>(angle_ / distance_); }
  /// A distance along the ray. Call if importance() is above 0.
  float sample(float u) const;
  /// Density of sample(), 1/length; 0 outside of the piece.
  float pdf(float t) const;

 private:
  double nearest_ = 0;   ///< t of the point nearest to the light
  double distance_ = 1;  ///< from there to the light; a wide light is as far as its radius
  double begin_ = 0, end_ = 0;
  double angle_ = 0;  ///< between both ends, seen from the light
};

}  // namespace nephroid
