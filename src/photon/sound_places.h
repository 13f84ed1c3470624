// Whether places that were read can be used: distances between them, and their squares, have to be
// numbers. It must not know what is there.
#pragma once

#include "core/math.h"

namespace nephroid {

/// No scene is so large, and none so small that what is learned of it is as small as the inverse.
inline constexpr float kLargestLength = 1e18f;

inline bool is_sound_place(const Vec3f& p) {
  const auto is_near = [](float x) { return std::abs(x) <= kLargestLength; };
  return is_near(p.x) && is_near(p.y) && is_near(p.z);
}

inline bool is_sound_ball(const Vec3f& center, float radius) {
  return is_sound_place(center) && radius >= 1 / kLargestLength && radius <= kLargestLength;
}

}  // namespace nephroid
