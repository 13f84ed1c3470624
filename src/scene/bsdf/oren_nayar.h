// The energy-preserving Oren-Nayar model of rough diffuse surfaces: a qualitative (Fujii) lobe of
// single scattering and one that returns what scatters more than once. It must not know textures.
// Paper: Portsmouth, Kutz & Hill, EON: A Practical Energy-Preserving Rough Diffuse BRDF, 2024.
#pragma once

#include "core/spectrum.h"

namespace nephroid {

class OrenNayar {
 public:
  /// `roughness` in [0,1]; 0 is Lambertian. `reflectance` is the albedo of the small facets.
  OrenNayar(const SampledSpectrum& reflectance, float roughness)
      : reflectance_(reflectance),
        roughness_(roughness),
        scale_(1.0f / (1.0f + (0.5f - 2.0f * kInvPi / 3.0f) * roughness)) {
    const float mean = mean_albedo();
    multiple_ = reflectance * reflectance *
                safe_div(SampledSpectrum(mean), SampledSpectrum(1.0f) - reflectance * (1 - mean)) /
                std::max(1.0f - mean, 1e-7f);
  }

  /// f times pi for two directions above the surface.
  SampledSpectrum pi_f(const Vec3f& wo, const Vec3f& wi) const {
    if (roughness_ == 0.0f) return reflectance_;
    const float s = dot(wo, wi) - wo.z * wi.z;
    const float slant = s > 0.0f ? s / std::max(std::max(wo.z, wi.z), 1e-7f) : s;
    const float lost = (1.0f - albedo(wo.z)) * (1.0f - albedo(wi.z));
    return reflectance_ * (scale_ * std::max(1.0f + roughness_ * slant, 0.0f)) +
           multiple_ * std::max(lost, 0.0f);
  }
  const SampledSpectrum& reflectance() const { return reflectance_; }

 private:
  /// Directional albedo of the single scattering of white facets.
  float albedo(float c) const {
    const float s = safe_sqrt(1.0f - c * c);
    const float tail = c > 1e-3f ? (1.0f - s * s * s) / c : 1.5f * c;
    const float g = s * (std::acos(std::min(c, 1.0f)) - s * c) + 2.0f / 3.0f * s * (tail - 1.0f);
    return scale_ * (1.0f + roughness_ * kInvPi * g);
  }
  float mean_albedo() const {
    return scale_ * (1.0f + (2.0f / 3.0f - 28.0f * kInvPi / 15.0f) * roughness_);
  }

  SampledSpectrum reflectance_, multiple_;
  float roughness_, scale_;
};

}  // namespace nephroid
