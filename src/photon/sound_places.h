// Checks places that were read from a file: squared distances between them must be finite. It must
// not know what the places are for.
#pragma once

#include "core/math.h"

namespace nephroid {

/// Bound of coordinates and radii; its inverse bounds radii from below. No scene comes near either.
inline constexpr float kLargestLength = 1e18f;

inline bool is_sound_place(const Vec3f& p) {
  const auto is_near = [](float x) { return std::abs(x) <= kLargestLength; };
  return is_near(p.x) && is_near(p.y) && is_near(p.z);
}

inline bool is_sound_ball(const Vec3f& center, float radius) {
  return is_sound_place(center) && radius >= 1 / kLargestLength && radius <= kLargestLength;
}

}  // namespace nephroid
