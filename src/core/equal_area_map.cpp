// Clarberg's map, see equal_area_map.h.
#include "core/equal_area_map.h"

namespace nephroid {

Vec3f equal_area_square_to_sphere(const Vec2f& square) {
  const float u = 2.0f * square.x - 1.0f, v = 2.0f * square.y - 1.0f;
  const float au = std::abs(u), av = std::abs(v);
  // Signed distance to the diamond that is the equator; r is the distance from the nearer pole.
  const float to_equator = 1.0f - (au + av);
  const float r = 1.0f - std::abs(to_equator);
  const float phi = (r == 0.0f ? 1.0f : (av - au) / r + 1.0f) * (kPi / 4.0f);
  const float ring = r * safe_sqrt(2.0f - r * r);
  return {std::copysign(std::cos(phi), u) * ring, std::copysign(std::sin(phi), v) * ring,
          std::copysign(1.0f - r * r, to_equator)};
}

Vec2f equal_area_sphere_to_square(const Vec3f& direction) {
  const float x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z);
  // sqrt(1 - |z|), computed from x and y where z is near 1 and the difference would cancel.
  const float ring2 = x * x + y * y;
  const float r = std::sqrt(ring2 < 0.5f ? ring2 / (1.0f + z) : std::max(0.0f, 1.0f - z));
  const float phi = (x == 0.0f && y == 0.0f) ? 0.0f : std::atan2(y, x) * (2.0f * kInvPi);
  float v = phi * r;
  float u = r - v;
  if (direction.z < 0.0f) {
    const float folded = 1.0f - v;
    v = 1.0f - u;
    u = folded;
  }
  u = std::copysign(u, direction.x);
  v = std::copysign(v, direction.y);
  return {std::clamp((u + 1.0f) * 0.5f, 0.0f, 1.0f), std::clamp((v + 1.0f) * 0.5f, 0.0f, 1.0f)};
}

}  // namespace nephroid
