// How light from outside enters the scene: through a disk that faces its direction, as wide as the
// scene's bounding sphere and just outside of it.
// Who calls it: distant and infinite lights. It must not know their radiance.
#pragma once

#include "core/warps.h"
#include "scene/light/light.h"

namespace nephroid {

/// A point outside of the scene, seen from `from` in unit direction `wi`.
inline Vec3f point_outside(const Vec3f& from, const Vec3f& wi, const SceneSphere& sphere) {
  return from + wi * (2.0f * sphere.radius);
}

/// Density of the origin of such a ray on the disk, 1/area.
inline float disk_pdf_a(const SceneSphere& sphere) {
  return 1.0f / (kPi * sqr(sphere.radius));
}

/// A ray into the scene along unit `w`, which was chosen with `pdf_w`.
inline EmissionSample emission_through_disk(const Vec3f& w, float pdf_w,
                                            const SampledSpectrum& radiance,
                                            const Vec2f& u_position, const SceneSphere& sphere) {
  const Frame frame = Frame::from_z(w);
  const Vec2f disk = square_to_disk(u_position);
  EmissionSample e;
  e.ray.o = sphere.center + (frame.x * disk.x + frame.y * disk.y - w) * sphere.radius;
  e.ray.d = w;
  e.radiance = radiance;
  e.pdf_a = disk_pdf_a(sphere);
  e.pdf_w = pdf_w;
  return e;
}

}  // namespace nephroid
