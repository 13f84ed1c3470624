// The phase function of Henyey & Greenstein 1941 about the axis of its peak; see phase_function.h.
// With a = |g| and x = 1 - cos(angle to the peak) it is
// (1 - a^2) / (4 pi ((1 - a)^2 + 2 a x)^(3/2)), which keeps precision at the peak for all g.
#include "scene/medium/phase_function.h"

namespace nephroid {

float HenyeyGreenstein::value(float x) const {
  const float a = std::abs(g_);
  const float s2 = sqr(1.0f - a) + 2.0f * a * x;
  return kInv4Pi * (1.0f - a) * (1.0f + a) / (s2 * std::sqrt(s2));
}

float HenyeyGreenstein::eval(const Vec3f& wo, const Vec3f& wi) const {
  // For unit vectors |v - w|^2 = 2 (1 - cos), without the cancellation of the right side.
  const Vec3f difference = g_ < 0.0f ? wi - wo : wi + wo;
  return value(0.5f * length_squared(difference));
}

PhaseSample HenyeyGreenstein::sample(const Vec3f& wo, const Vec2f& u) const {
  // Inverse of the distribution function, with v = 1 at the peak:
  // x = 2 (1 - a)^2 (1 - v) (1 + a v) / (1 - a + 2 a v)^2. It needs no special case at a = 0.
  const float a = std::abs(g_);
  const float v = g_ < 0.0f ? u.x : 1.0f - u.x;
  const float one_minus_v = g_ < 0.0f ? 1.0f - u.x : u.x;
  const float x = std::min(
      2.0f, 2.0f * one_minus_v * (1.0f + a * v) * sqr((1.0f - a) / (1.0f - a + 2.0f * a * v)));
  const float r = safe_sqrt(x * (2.0f - x));
  const float phi = 2.0f * kPi * u.y;
  const Frame frame = Frame::from_z(g_ < 0.0f ? wo : -wo);
  PhaseSample s;
  s.wi = normalize(frame.to_world({r * std::cos(phi), r * std::sin(phi), 1.0f - x}));
  s.pdf_w = value(x);
  return s;
}

}  // namespace nephroid
