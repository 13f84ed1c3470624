// The lobe by which light scattered below a surface leaves it: isotropic inside, then through a
// smooth boundary, scaled so that all of it leaves. Class D. It must not know profiles. Sources:
// pbrt-v4's NormalizedFresnelBxDF; Jensen et al. 2001 for the scale, written as a Fresnel moment
// (d'Eon & Irving 2011).
#pragma once

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// f = (1 - F(wi)) / (c pi) for wo and wi above, c the mean of 1 - F over a hemisphere; times eta^2
/// in kRadiance mode. It depends on the sampled direction only: wo is the surface normal, because
/// the path arrived by a subsurface step, not along a direction.
class NormalizedFresnelBsdf final : public Bsdf {
 public:
  /// `eta` is the index below over the index above.
  explicit NormalizedFresnelBsdf(float eta);

  ClassMask classes() const override { return ClassMask::kDiffuse; }
  ClassMask finite_classes() const override { return ClassMask::kDiffuse; }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f&) const override { return SampledSpectrum(1.0f); }

 private:
  float f(const Vec3f& wi, TransportMode mode) const;

  float eta_, scale_;
};

}  // namespace nephroid
