// Boundaries between transparent media, smooth or rough, which reflect and refract; and thin panes,
// which transmit straight through. Values do not depend on the wavelength: with dispersion the
// material keeps one wavelength and its index. It must not know textures or media. Paper: Walter et
// al. 2007 (generalised half vector, Jacobians).
#pragma once

#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/microfacet.h"

namespace nephroid {

/// The requested part of a boundary's scattering.
enum class BoundaryPart : uint8_t { kReflection, kTransmission, kBoth };

/// A boundary; `eta` is the index below over the index above.
struct DielectricInterface {
  float eta = 1.5f;
  TrowbridgeReitz facets;

  struct Value {
    float f = 0;  ///< without cosine
    float pdf_w = 0;
  };
  struct Sample {
    Vec3f wi;
    float weight = 0;  ///< f * |cos| / pdf_w
    float pdf_w = 0;   ///< a discrete probability if the boundary is smooth
    float eta = 1;     ///< index at wi over index at wo
    bool transmitted = false;
  };

  /// True if all lobes are delta functions.
  bool smooth() const { return eta == 1.0f || facets.smooth(); }
  /// Class of the lobes: S if smooth or not rougher than `specular_alpha`, else G.
  EventClass event_class(float specular_alpha) const {
    return smooth() ? EventClass::kSpecular : facets.event_class(specular_alpha);
  }
  /// Share of flux that a smooth boundary reflects on the side of w.
  float fresnel(const Vec3f& w) const { return eta == 1.0f ? 0.0f : fresnel_dielectric(w.z, eta); }
  /// Index at wi over index at wo.
  float eta_between(const Vec3f& wo, const Vec3f& wi) const {
    if ((wo.z > 0.0f) == (wi.z > 0.0f)) return 1.0f;
    return wo.z > 0.0f ? eta : 1.0f / eta;
  }
  /// f from wi to wo, and the density of sample(wo, ..., part); zero if smooth.
  Value evaluate(const Vec3f& wo, const Vec3f& wi, TransportMode mode, BoundaryPart part) const;
  /// Samples a direction of `part`; kBoth chooses by the Fresnel term. Empty if the light does not
  /// get away: shadowed facets, or total reflection when only transmission is requested.
  std::optional<Sample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                               BoundaryPart part) const;
};

/// Both lobes have the same class, S or G by roughness. With eta = 1 the boundary does nothing:
/// light goes straight through, which is no event, whatever `among` holds.
class DielectricBsdf final : public Bsdf {
 public:
  DielectricBsdf(const DielectricInterface& boundary, float specular_alpha)
      : boundary_(boundary), class_(boundary.event_class(specular_alpha)) {}

  ClassMask classes() const override { return mask_of(class_); }
  ClassMask finite_classes() const override {
    return boundary_.smooth() ? ClassMask::kNone : mask_of(class_);
  }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  std::optional<std::array<BsdfSample, 2>> delta_pair(const Vec3f& wo,
                                                      TransportMode mode) const override;
  float eta_between(const Vec3f& wo, const Vec3f& wi) const override {
    return boundary_.eta_between(wo, wi);
  }
  SampledSpectrum albedo(const Vec3f&) const override { return SampledSpectrum(1.0f); }

 private:
  DielectricInterface boundary_;
  EventClass class_;
};

/// A pane of two parallel boundaries, with all reflections between them summed. Reflection is a
/// delta lobe of class S. Transmission goes straight through: it is no event, and is sampled
/// whatever `among` holds. No direction depends on the wavelength, so `eta` is a spectrum.
class ThinDielectricBsdf final : public Bsdf {
 public:
  explicit ThinDielectricBsdf(const SampledSpectrum& eta) : eta_(eta) {}

  /// Share of flux that the pane reflects at cosine `cos_i`, whose absolute value is taken.
  static SampledSpectrum pane_reflectance(float cos_i, const SampledSpectrum& eta);

  ClassMask classes() const override { return ClassMask::kSpecular; }
  ClassMask finite_classes() const override { return ClassMask::kNone; }
  BsdfEval eval(const Vec3f&, const Vec3f&, TransportMode, EventClass, ClassMask) const override {
    return {};
  }
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f&) const override { return SampledSpectrum(1.0f); }

 private:
  SampledSpectrum eta_;
};

}  // namespace nephroid
