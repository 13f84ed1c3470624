// Maps from the unit square to common distributions, with their densities. All are continuous or
// nearly so, so that stratified points stay stratified.
#pragma once

#include "core/math.h"

namespace nephroid {

/// Uniform on the unit disk (Shirley & Chiu 1997); density 1/pi.
inline Vec2f square_to_disk(const Vec2f& u) {
  const float x = 2.0f * u.x - 1.0f, y = 2.0f * u.y - 1.0f;
  if (x == 0.0f && y == 0.0f) return {0.0f, 0.0f};
  float r, phi;
  if (std::abs(x) > std::abs(y)) {
    r = x;
    phi = kPi / 4.0f * (y / x);
  } else {
    r = y;
    phi = kPi / 2.0f - kPi / 4.0f * (x / y);
  }
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// Unit vector in the upper hemisphere with density cos(theta)/pi.
inline Vec3f square_to_cosine_hemisphere(const Vec2f& u) {
  const Vec2f d = square_to_disk(u);
  return {d.x, d.y, safe_sqrt(1.0f - d.x * d.x - d.y * d.y)};
}
inline float cosine_hemisphere_pdf_w(float cos_theta) {
  return cos_theta > 0.0f ? cos_theta * kInvPi : 0.0f;
}

/// Unit vector, uniform on the sphere; density 1/(4 pi).
inline Vec3f square_to_sphere(const Vec2f& u) {
  const float z = 1.0f - 2.0f * u.x;
  const float r = safe_sqrt(1.0f - z * z);
  const float phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Barycentric coordinates (b0, b1) uniform in a triangle, low distortion (Heitz 2019).
inline Vec2f square_to_triangle(const Vec2f& u) {
  float b0 = u.x * 0.5f, b1 = u.y * 0.5f;
  const float offset = b1 - b0;
  if (offset > 0.0f)
    b1 += offset;
  else
    b0 -= offset;
  return {b0, b1};
}

/// Power heuristic with exponent 2 for one sample of each technique.
inline float power_heuristic(float pdf_a_technique, float pdf_other) {
  if (std::isinf(sqr(pdf_a_technique))) return 1.0f;
  const float a = sqr(pdf_a_technique), b = sqr(pdf_other);
  return a > 0.0f ? a / (a + b) : 0.0f;
}

}  // namespace nephroid
