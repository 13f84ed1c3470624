// Code that all cameras share: shutter, world space and a pixel's footprint; see camera.h.
#include "scene/camera/camera.h"

namespace nephroid {

float CameraPlacement::motion_time(float u_time) const {
  if (!(keyframe_end > keyframe_start)) return 0.0f;
  const float time = lerp(u_time, shutter_open, shutter_close);
  return std::clamp((time - keyframe_start) / (keyframe_end - keyframe_start), 0.0f, 1.0f);
}

Ray Camera::world_ray(const Vec3f& o, const Vec3f& d, float u_time) const {
  Ray ray;
  ray.time = motion_time(u_time);
  const Transform to_world = camera_to_world(ray.time);
  ray.o = to_world.point(o);
  ray.d = normalize(to_world.vector(d));
  return ray;
}

std::optional<Camera::Sight> Camera::see(const Vec3f& p, const Vec3f& lens, float u_time) const {
  const Transform to_world = camera_to_world(motion_time(u_time));
  const Mat44d& i = to_world.inverse;
  Sight s;
  s.lens = to_world.point(lens);
  const Vec3f way = p - s.lens;
  s.distance = length(way);
  s.d = normalize(way);
  s.v = to_world.inverted().vector(s.d);
  s.camera_volume = static_cast<float>(std::abs(i[0][0] * (i[1][1] * i[2][2] - i[1][2] * i[2][1]) -
                                                i[0][1] * (i[1][0] * i[2][2] - i[1][2] * i[2][0]) +
                                                i[0][2] * (i[1][0] * i[2][1] - i[1][1] * i[2][0])));
  if (!(s.distance > 0) || !is_finite(s.v) || !(s.camera_volume > 0)) return std::nullopt;
  return s;
}

PixelFootprint footprint_of_central_pixel(const Camera& camera, const CameraFilm& film) {
  constexpr Vec2f kMiddle(0.5f, 0.5f);
  const Vec2f centre(static_cast<float>(film.width) / 2, static_cast<float>(film.height) / 2);
  const std::optional<CameraRay> here = camera.generate_ray(centre, kMiddle, 0.5f);
  PixelFootprint footprint;
  if (!here) return footprint;
  for (const Vec2f& step : {Vec2f(1, 0), Vec2f(0, 1)}) {
    const std::optional<CameraRay> there = camera.generate_ray(centre + step, kMiddle, 0.5f);
    if (!there) continue;
    footprint.offset = std::max(footprint.offset, length(there->ray.o - here->ray.o));
    footprint.spread = std::max(footprint.spread, length(there->ray.d - here->ray.d));
  }
  return footprint;
}

}  // namespace nephroid
