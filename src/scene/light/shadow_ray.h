// The ray from a point to a light sample, for visibility tests.
#pragma once

#include "scene/light/light.h"

namespace nephroid {

/// From `origin`, already offset from the point's surface. Of unit length to infinite lights; else
/// it ends at t = 1, just before the emitter.
inline Ray shadow_ray(const Vec3f& origin, const LightSample& s, float time) {
  Ray ray;
  ray.o = origin;
  ray.time = time;
  if (s.infinite) {
    ray.d = s.wi;
    return ray;
  }
  // Both ends are offset by their own error bounds. The margin on t_max keeps the ray from reaching
  // the emitter itself.
  const Vec3f end = length_squared(s.ng) > 0 ? offset_ray_origin(s.p, s.p_error, s.ng, -s.wi) : s.p;
  ray.d = end - origin;
  ray.t_max = 1.0f - 1e-5f;
  return ray;
}

}  // namespace nephroid
