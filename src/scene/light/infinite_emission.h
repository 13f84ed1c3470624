// Emission from infinitely far lights: through a disk that faces the direction, as wide as the
// scene's bounding sphere and just outside of it. It must not know the lights' radiance.
#pragma once

#include "core/warps.h"
#include "scene/light/light.h"

namespace nephroid {

/// A point outside of the scene, in unit direction `wi` from `from`.
inline Vec3f point_outside(const Vec3f& from, const Vec3f& wi, const SceneSphere& sphere) {
  return from + wi * (2.0f * sphere.radius);
}

/// Density of the ray's origin on the disk, 1/area.
inline float disk_pdf_a(const SceneSphere& sphere) {
  return 1.0f / (kPi * sqr(sphere.radius));
}

/// A ray into the scene along unit `w`, which was sampled with density `pdf_w`.
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
