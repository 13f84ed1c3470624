// How light that was scattered below a surface leaves it: evenly inside, then through a smooth
// boundary, scaled so that all of it gets out. Class D. Who calls it: TabulatedBssrdf, for the
// point where the light leaves. It must not know profiles. Source: pbrt-v4's NormalizedFresnelBxDF;
// the scale is that of Jensen et al. 2001 as a moment of the Fresnel term (d'Eon & Irving 2011).
#pragma once

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// f = (1 - F(wi)) / (c pi) for wo and wi above, c the mean of 1 - F over a hemisphere; in
/// kRadiance mode times eta^2. It depends on the newly sampled direction only: wo is the surface's
/// normal, since what came before is no direction but a place.
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
