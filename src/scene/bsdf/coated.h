// A dielectric coat on an opaque base, in full generality: rough or anisotropic coat, any base, a
// scattering medium in the gap. The coat's own reflection is exact, the rest a random walk per
// evaluation (layered_walk.h). Sampling mixes explicit densities, so pdfs are exact although values
// are estimates. It must not know textures. coated_diffuse.h is the fast special case.
#pragma once

#include "scene/bsdf/conductor.h"
#include "scene/bsdf/diffuse.h"
#include "scene/bsdf/layered_walk.h"

namespace nephroid {

/// Both sides alike, opaque. The coat's own reflection is S or G by the coat's roughness. The rest
/// is D on a Lambertian base and where the gap scatters. On a metal under a clear gap it is S if
/// coat and metal both are, else G. Lobes of the same class add up. Two smooth boundaries form one
/// mirror that includes the reflections between them.
template <class Base>
class CoatedBsdf final : public Bsdf {
 public:
  CoatedBsdf(const Coat& coat, const Base& base, float specular_alpha);

  ClassMask classes() const override;
  ClassMask finite_classes() const override;
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f& wo) const override;

 private:
  /// Probabilities of the sampling densities: the coat's reflection, the base's reflection widened
  /// by the coat, and a cosine lobe for all else. They sum to 1 or are all 0.
  struct Shares {
    float coat = 0, lobe = 0, cosine = 0;
  };
  Shares shares(const Vec3f& wo, ClassMask among) const;
  /// Facets, seen from outside, that approximate the base under the coat.
  TrowbridgeReitz widened(const Vec3f& wo) const;
  float lobe_pdf_w(const Vec3f& wo, const Vec3f& wi) const;
  BsdfEval eval_above(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                      const Shares& p) const;
  /// Share of flux that leaves along the mirror direction after it was reflected by a smooth base.
  SampledSpectrum mirrored_by_base(const Vec3f& wo) const;
  SampledSpectrum base_albedo(float cos_inside) const;

  Coat coat_;
  Base base_;
  EventClass coat_class_, base_class_;
  bool all_smooth_;       ///< the coat and the base are mirrors
  bool base_has_finite_;  ///< some lobe of the base is not a delta function
};

extern template class CoatedBsdf<LambertSurface>;
extern template class CoatedBsdf<ConductorSurface>;

}  // namespace nephroid
