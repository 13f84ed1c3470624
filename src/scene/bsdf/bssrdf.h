// The interface of light that enters a surface at one point and leaves it at another, for the
// separable profile of pbrt-v4: S(po, wo, pi, wi) = (1 - F(wo)) Sp(|po - pi|) Sw(wi), [B1] of
// docs/estimators.md.
// Who calls it: the walk, which finds the second point by a probe ray through the shape
// (King et al. 2013). It must not know rays, shapes or routes.
#pragma once

#include <optional>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// A line along which the walk looks for the other point, world space.
struct BssrdfProbe {
  Vec3f start{0, 0, 0}, end{0, 0, 0};
};

class Bssrdf {
 public:
  virtual ~Bssrdf() = default;

  /// A probe around the point that the Bssrdf was made for. `u_axis` chooses one of the three axes
  /// and then, evenly, one of the path's wavelengths; `u` radius and angle in the plane across the
  /// axis, by that wavelength's profile. Empty if the radius lies beyond the largest that is
  /// sampled.
  virtual std::optional<BssrdfProbe> sample_probe(float u_axis, const Vec2f& u) const = 0;

  /// Sp at another point, per area in the scene's units. 0 for wavelengths that were dropped.
  virtual SampledSpectrum sp(const Vec3f& p) const = 0;
  /// Density pdf_a with which sample_probe passes through `p` where the surface has geometric
  /// normal `ng`: the mean over the choices of axis and wavelength, so that sp / pdf_a has no bias
  /// at any wavelength, and is bounded where profiles of other wavelengths are narrower.
  virtual float pdf_a(const Vec3f& p, const Vec3f& ng) const = 0;

  /// How light leaves at the other point: class D, reflection lobe only, in the frame of that
  /// point, for wo along its normal. It carries (1 - F(wi)) / (c pi), times eta^2 in kRadiance
  /// mode, which undoes the scaling of the transmission that led in.
  virtual const Bsdf* exit_bsdf(BsdfArena& arena) const = 0;
};

}  // namespace nephroid
