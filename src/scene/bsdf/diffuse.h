// Lambertian reflection, and Lambertian reflection with Lambertian transmission. Class D. It must
// not know textures.
#pragma once

#include "core/warps.h"
#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// Reflects the same radiance in all directions on wo's side.
class DiffuseBsdf final : public Bsdf {
 public:
  explicit DiffuseBsdf(const SampledSpectrum& reflectance) : reflectance_(reflectance) {}

  ClassMask classes() const override { return ClassMask::kDiffuse; }
  ClassMask finite_classes() const override { return ClassMask::kDiffuse; }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode, EventClass c,
                ClassMask among) const override {
    BsdfEval e;
    if (c != EventClass::kDiffuse || !contains(among, c) || !same_hemisphere(wo, wi)) return e;
    e.f = reflectance_ * kInvPi;
    e.pdf_w = abs_cos_theta(wi) * kInvPi;
    return e;
  }
  std::optional<BsdfSample> sample(const Vec3f& wo, float, const Vec2f& u, TransportMode,
                                   ClassMask among) const override {
    if (wo.z == 0.0f || !contains(among, EventClass::kDiffuse)) return std::nullopt;
    BsdfSample s;
    s.wi = square_to_cosine_hemisphere(u);
    if (!(s.wi.z > 0.0f)) return std::nullopt;
    s.pdf_w = s.wi.z * kInvPi;
    if (wo.z < 0.0f) s.wi.z = -s.wi.z;
    s.f = reflectance_ * kInvPi;
    return s;
  }
  SampledSpectrum albedo(const Vec3f&) const override { return reflectance_; }

 private:
  SampledSpectrum reflectance_;
};

/// Reflects to one side and transmits to the other, both Lambertian. There is no refraction, so
/// radiance and importance are the same.
class DiffuseTransmissionBsdf final : public Bsdf {
 public:
  DiffuseTransmissionBsdf(const SampledSpectrum& reflectance, const SampledSpectrum& transmittance)
      : reflectance_(reflectance), transmittance_(transmittance) {
    const float r = reflectance.max_component(), t = transmittance.max_component();
    has_lobes_ = r + t > 0.0f;
    reflect_p_ = has_lobes_ ? r / (r + t) : 0.0f;
  }

  ClassMask classes() const override { return ClassMask::kDiffuse; }
  ClassMask finite_classes() const override { return ClassMask::kDiffuse; }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode, EventClass c,
                ClassMask among) const override {
    BsdfEval e;
    if (!has_lobes_ || c != EventClass::kDiffuse || !contains(among, c) || wo.z == 0.0f ||
        wi.z == 0.0f)
      return e;
    const bool reflects = (wo.z > 0.0f) == (wi.z > 0.0f);
    e.f = (reflects ? reflectance_ : transmittance_) * kInvPi;
    e.pdf_w = (reflects ? reflect_p_ : 1.0f - reflect_p_) * abs_cos_theta(wi) * kInvPi;
    return e;
  }
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode,
                                   ClassMask among) const override {
    if (!has_lobes_ || wo.z == 0.0f || !contains(among, EventClass::kDiffuse)) return std::nullopt;
    BsdfSample s;
    s.wi = square_to_cosine_hemisphere(u);
    if (!(s.wi.z > 0.0f)) return std::nullopt;
    s.transmitted = uc >= reflect_p_;
    s.pdf_w = (s.transmitted ? 1.0f - reflect_p_ : reflect_p_) * s.wi.z * kInvPi;
    s.f = (s.transmitted ? transmittance_ : reflectance_) * kInvPi;
    if ((wo.z < 0.0f) != s.transmitted) s.wi.z = -s.wi.z;
    return s;
  }
  SampledSpectrum albedo(const Vec3f&) const override { return reflectance_ + transmittance_; }

 private:
  SampledSpectrum reflectance_, transmittance_;
  float reflect_p_ = 0;
  bool has_lobes_ = false;
};

/// A Lambertian surface as the base of a coat, seen from above only.
struct LambertSurface {
  SampledSpectrum reflectance;

  struct Value {
    SampledSpectrum f;
    float pdf_w = 0;
  };
  struct Sample {
    SampledSpectrum weight;  ///< f * cos / pdf_w
    Vec3f wi;
    float pdf_w = 0;
  };
  bool smooth() const { return false; }
  /// f and the density of sample(), both directions above.
  Value evaluate(const Vec3f&, const Vec3f& wi) const {
    return {reflectance * kInvPi, wi.z * kInvPi};
  }
  std::optional<Sample> sample(const Vec3f&, const Vec2f& u) const {
    const Vec3f wi = square_to_cosine_hemisphere(u);
    if (!(wi.z > 0.0f)) return std::nullopt;
    return Sample{reflectance, wi, wi.z * kInvPi};
  }
};

}  // namespace nephroid
