// Reflection by metals: a mirror or rough facets, tinted by the complex Fresnel term. Class S if
// smooth or at most as rough as the threshold, else G. It must not know textures. Papers: Walter et
// al. 2007; Heitz 2014 (shadowing).
#pragma once

#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/microfacet.h"

namespace nephroid {

/// The surface of a metal with index eta + i k relative to the medium above. Opaque, both sides
/// alike.
struct ConductorSurface {
  SampledSpectrum eta, k;
  TrowbridgeReitz facets;

  struct Value {
    SampledSpectrum f;
    float pdf_w = 0;
  };
  struct Sample {
    SampledSpectrum weight;  ///< f * cos / pdf_w
    Vec3f wi;
    float pdf_w = 0;  ///< 1 for the mirror
  };

  bool smooth() const { return facets.smooth(); }
  SampledSpectrum fresnel(float cos_i) const { return fresnel_conductor(cos_i, eta, k); }
  /// f without cosine, and pdf_w of sample(). Black if smooth, or if wo and wi are on different
  /// sides.
  Value evaluate(const Vec3f& wo, const Vec3f& wi) const;
  /// Empty if the sampled facet reflects into the surface.
  std::optional<Sample> sample(const Vec3f& wo, const Vec2f& u) const;
};

class ConductorBsdf final : public Bsdf {
 public:
  ConductorBsdf(const ConductorSurface& surface, float specular_alpha)
      : surface_(surface), class_(surface.facets.event_class(specular_alpha)) {}

  ClassMask classes() const override { return mask_of(class_); }
  ClassMask finite_classes() const override {
    return surface_.smooth() ? ClassMask::kNone : mask_of(class_);
  }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f& wo) const override {
    return surface_.fresnel(abs_cos_theta(wo));
  }

 private:
  ConductorSurface surface_;
  EventClass class_;
};

}  // namespace nephroid
