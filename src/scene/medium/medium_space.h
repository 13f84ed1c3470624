// The box that a medium fills, as the unit cube of its grids. Maps points and clips rays in double
// precision, so that boxes and ray origins far away lose none. It must not know what fills the box.
#pragma once

#include <optional>

#include "core/math.h"
#include "input/scene_description.h"

namespace nephroid {

/// The part of a ray inside the cube: o + t d for t_min <= t < t_max, with t as on the world ray.
struct CubeRay {
  Vec3d o, d;
  float t_min = 0, t_max = 0;
};

class MediumSpace {
 public:
  /// The box between `p_min` and `p_max` in medium space; its volume is not zero.
  /// `world_from_medium` is affine and invertible.
  MediumSpace(const Mat44d& world_from_medium, const Vec3d& p_min, const Vec3d& p_max);

  /// World point to medium space, which the scene's transform maps to the world.
  Vec3d to_medium(const Vec3f& p) const { return map_point(medium_from_world_, p); }
  /// World point to the cube [0,1]^3.
  Vec3f to_cube(const Vec3f& p) const {
    const Vec3d c = map_point(cube_from_world_, p);
    return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
  }
  /// The part of a world ray inside the box and before `t_max`. Empty if there is none, or if one
  /// of its coordinates is not finite.
  std::optional<CubeRay> overlap(const Ray& ray, float t_max) const;

 private:
  static Vec3d map_point(const Mat44d& m, const Vec3f& p);

  Mat44d medium_from_world_, cube_from_world_;
};

/// The box between "p0" and "p1", by default the unit cube. Throws SceneError if it is flat.
MediumSpace read_medium_box(const MediumDescription& description);

}  // namespace nephroid
