// Random numbers for tests of scenes, the same in every run.
#pragma once

#include <cstdint>

#include "core/math.h"
#include "core/sampler.h"

namespace nephroid {

struct Numbers {
  uint64_t state;

  /// Uniform in [0, 1).
  float operator()() {
    return bits_to_unit_float(
        static_cast<uint32_t>(mix_bits(++state * 0x9e3779b97f4a7c15ull) >> 32));
  }
  Vec2f pair() {
    const float x = (*this)();
    return {x, (*this)()};
  }
  /// In the cube of that half edge around the origin.
  Vec3f in_cube(float half) {
    const float x = (*this)(), y = (*this)(), z = (*this)();
    return (Vec3f(x, y, z) * 2.0f - Vec3f(1, 1, 1)) * half;
  }
};

}  // namespace nephroid
