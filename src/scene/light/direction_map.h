// Directions between a light's local frame and the world, with the change of solid angle, so that
// lights under scaling transforms stay exact. It must not know lights.
#pragma once

#include "core/math.h"

namespace nephroid {

class DirectionMap {
 public:
  DirectionMap() = default;
  explicit DirectionMap(const Transform& local_to_world);

  Vec3f to_world(const Vec3f& local) const { return normalize(transform_.vector(local)); }
  Vec3f to_local(const Vec3f& world) const { return normalize(inverse_.vector(world)); }
  /// True if the map is a rotation, a mirror or a uniform scale: solid angles do not change.
  bool keeps_angles() const { return keeps_angles_; }
  /// Solid angle in the world over solid angle in the local frame, at a unit local direction.
  float jacobian(const Vec3f& local) const;

 private:
  Transform transform_, inverse_;
  double determinant_ = 1.0;
  bool keeps_angles_ = true;
};

}  // namespace nephroid
