// Fresnel reflectance of dielectrics and conductors for unpolarised light, and refraction and
// reflection of directions. It must not know roughness or layers. Sources: Born & Wolf, Principles
// of Optics; pbrt-v4 section 9.3 (sign conventions).
#pragma once

#include "core/spectrum.h"

namespace nephroid {

/// Share of flux that a smooth boundary reflects. `eta` is the index below over the index above.
/// `cos_i` in [-1,1] is measured from the normal above: negative for light from below.
inline float fresnel_dielectric(float cos_i, float eta) {
  cos_i = std::clamp(cos_i, -1.0f, 1.0f);
  if (cos_i < 0.0f) {
    eta = 1.0f / eta;
    cos_i = -cos_i;
  }
  const float sin2_t = (1.0f - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0f) return 1.0f;
  const float cos_t = std::sqrt(1.0f - sin2_t);
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Share of flux that a conductor with index eta + i k (relative to the outside) reflects;
/// `cos_i` in [0,1].
inline SampledSpectrum fresnel_conductor(float cos_i, const SampledSpectrum& eta,
                                         const SampledSpectrum& k) {
  cos_i = std::clamp(cos_i, 0.0f, 1.0f);
  const float cos2 = cos_i * cos_i, sin2 = 1.0f - cos2;
  SampledSpectrum result;
  for (int i = 0; i < kSpectrumSamples; ++i) {
    // a + i b is the square root of (eta + i k)^2 - sin^2; a2_b2 its squared modulus.
    const float eta2 = eta[i] * eta[i], k2 = k[i] * k[i];
    const float t0 = eta2 - k2 - sin2;
    const float a2_b2 = std::sqrt(t0 * t0 + 4.0f * eta2 * k2);
    const float a = std::sqrt(std::max(0.0f, 0.5f * (a2_b2 + t0)));
    const float t1 = a2_b2 + cos2, t2 = 2.0f * a * cos_i;
    const float perpendicular = (t1 - t2) / std::max(t1 + t2, 1e-30f);
    const float t3 = cos2 * a2_b2 + sin2 * sin2, t4 = t2 * sin2;
    const float parallel = perpendicular * (t3 - t4) / std::max(t3 + t4, 1e-30f);
    result.set(i, std::clamp(0.5f * (perpendicular + parallel), 0.0f, 1.0f));
  }
  return result;
}

/// Mirror image of `w` about the unit vector `m`; both point away from the surface.
inline Vec3f reflect_about(const Vec3f& w, const Vec3f& m) {
  return m * (2.0f * dot(w, m)) - w;
}

/// Refracts `w`, which points away from the surface, at a facet `m`. `eta` is the index on the side
/// opposite to m over the one on m's side. `eta_path` becomes the index at the result over the
/// index at w. False for total reflection.
inline bool refract_about(const Vec3f& w, Vec3f m, float eta, Vec3f* result, float* eta_path) {
  float cos_i = dot(w, m);
  if (cos_i < 0.0f) {
    eta = 1.0f / eta;
    cos_i = -cos_i;
    m = -m;
  }
  const float sin2_t = std::max(0.0f, 1.0f - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1.0f) return false;
  const float cos_t = std::sqrt(1.0f - sin2_t);
  *result = w * (-1.0f / eta) + m * (cos_i / eta - cos_t);
  *eta_path = eta;
  return true;
}

}  // namespace nephroid
