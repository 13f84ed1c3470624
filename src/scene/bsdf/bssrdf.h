// The interface of light that enters a surface at one point and leaves it at another, [B1] of
// docs/estimators.md:
// S(po, wo, pi, wi) = (1 - F(wo)) Sp(|po - pi|) Sw(wi), pbrt-v4's separable profile. The walk finds
// the second point by a probe ray (King et al. 2013). It must not know rays, shapes or routes.
#pragma once

#include <optional>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// A line segment along which the walk looks for the second point, world space.
struct BssrdfProbe {
  Vec3f start{0, 0, 0}, end{0, 0, 0};
};

class Bssrdf {
 public:
  virtual ~Bssrdf() = default;

  /// A probe around the point that the Bssrdf was made for. `u_axis` chooses one of the three axes,
  /// then uniformly one of the path's wavelengths. `u` gives radius and angle in the plane
  /// perpendicular to the axis, by that wavelength's profile. Empty if the radius exceeds the
  /// largest that is sampled.
  virtual std::optional<BssrdfProbe> sample_probe(float u_axis, const Vec2f& u) const = 0;

  /// Sp at another point, per area in the scene's units. 0 for terminated wavelengths.
  virtual SampledSpectrum sp(const Vec3f& p) const = 0;
  /// Density pdf_a with which sample_probe hits `p`, where the surface has geometric normal `ng`.
  /// It is the mean over the choices of axis and wavelength, so sp / pdf_a is unbiased at every
  /// wavelength and bounded where another wavelength's profile is narrower.
  virtual float pdf_a(const Vec3f& p, const Vec3f& ng) const = 0;

  /// How light leaves at the second point: class D, reflection only, in that point's frame, for wo
  /// along its normal. It carries (1 - F(wi)) / (c pi). In kRadiance mode it also carries eta^2,
  /// which undoes the scaling of the transmission that led in.
  virtual const Bsdf* exit_bsdf(BsdfArena& arena) const = 0;
};

}  // namespace nephroid
