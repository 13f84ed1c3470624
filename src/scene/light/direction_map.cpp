// Directions under affine maps, see direction_map.h.
#include "scene/light/direction_map.h"

namespace nephroid {

DirectionMap::DirectionMap(const Transform& local_to_world)
    : transform_(local_to_world), inverse_(local_to_world.inverted()) {
  const auto row = [&](int i) {
    return Vec3d(transform_.m[i][0], transform_.m[i][1], transform_.m[i][2]);
  };
  const Vec3d x = row(0), y = row(1), z = row(2);
  determinant_ = std::abs(x.dot(y.cross(z)));
  // Orthogonal rows of equal length: a rotation, a mirror or a uniform scale.
  const double l2 = x.dot(x);
  const double worst = std::max({std::abs(y.dot(y) - l2), std::abs(z.dot(z) - l2),
                                 std::abs(x.dot(y)), std::abs(y.dot(z)), std::abs(z.dot(x))});
  keeps_angles_ = worst <= 1e-6 * l2;
}

float DirectionMap::jacobian(const Vec3f& local) const {
  if (keeps_angles_) return 1.0f;
  const double l = length(transform_.vector(local));
  return static_cast<float>(determinant_ / (l * l * l));
}

}  // namespace nephroid
