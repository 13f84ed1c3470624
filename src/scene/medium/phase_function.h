// The phase function of Henyey & Greenstein 1941 in pbrt's convention: wo and wi both point away
// from the vertex, so g > 0 scatters forward, to where dot(wo, wi) = -1. It must not know rays or
// routes.
#pragma once

#include "core/math.h"

namespace nephroid {

/// A direction sampled from a phase function; value and density are equal.
struct PhaseSample {
  Vec3f wi{0, 0, 1};  ///< unit, world
  float pdf_w = 0;    ///< 1/sr
};

class HenyeyGreenstein {
 public:
  HenyeyGreenstein() = default;
  /// `g`: mean cosine of the deflection, clamped to [-0.99, 0.99] as in pbrt-v4.
  explicit HenyeyGreenstein(float g) : g_(std::clamp(g, -0.99f, 0.99f)) {}
  float g() const { return g_; }

  /// Value and density, which are equal (1/sr), for unit world directions.
  float eval(const Vec3f& wo, const Vec3f& wi) const;
  /// Always succeeds, for `u` in [0,1)^2. As in pbrt-v4, small u.x give the deflections that g >= 0
  /// prefers.
  PhaseSample sample(const Vec3f& wo, const Vec2f& u) const;

 private:
  /// The value for 1 - cos = x, the cosine taken between the direction and the lobe's axis.
  float value(float x) const;

  float g_ = 0;
};

}  // namespace nephroid
