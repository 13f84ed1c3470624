// The box that a medium fills, as the unit cube of its grids: maps points and cuts rays, in double
// precision, so that a box far from the origin or a distant ray origin costs no digits here.
// Who calls it: the media that fill a box. It must not know what fills it.
#pragma once

#include <optional>

#include "core/math.h"
#include "input/scene_description.h"

namespace nephroid {

/// The part of a ray inside the cube: o + t d for t_min <= t < t_max, t as on the world ray.
struct CubeRay {
  Vec3d o, d;
  float t_min = 0, t_max = 0;
};

class MediumSpace {
 public:
  /// The box between `p_min` and `p_max` of medium space, which has a volume; `world_from_medium`
  /// is affine and has an inverse.
  MediumSpace(const Mat44d& world_from_medium, const Vec3d& p_min, const Vec3d& p_max);

  /// World point in the space that the scene's transform maps to the world.
  Vec3d to_medium(const Vec3f& p) const { return map_point(medium_from_world_, p); }
  /// World point in units of the box, which is [0,1]^3.
  Vec3f to_cube(const Vec3f& p) const {
    const Vec3d c = map_point(cube_from_world_, p);
    return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
  }
  /// Where a world ray runs inside the box before `t_max`; empty if it never does, or if one of
  /// its coordinates is not finite.
  std::optional<CubeRay> overlap(const Ray& ray, float t_max) const;

 private:
  static Vec3d map_point(const Mat44d& m, const Vec3f& p);

  Mat44d medium_from_world_, cube_from_world_;
};

/// The box between "p0" and "p1", the unit cube if absent. Throws SceneError if it is flat.
MediumSpace read_medium_box(const MediumDescription& description);

}  // namespace nephroid
