// Scattering by a hair fibre, a rough dielectric cylinder with absorption inside. All lobes are
// class D and cover the whole sphere; the events have the letter H. Conventions of angles, scales
// and roughness: pbrt-v4 section 9.9. It must not know curves, textures or pigments. Papers: Chiang
// et al. 2016, A Practical and Controllable Hair and Fur Model; d'Eon et al. 2011 (lobes).
#pragma once

#include <array>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// The fibre's roughness and scale tilt, without colour and position.
struct HairShape {
  static constexpr int kLobes = 4;  ///< R, TT, TRT, and all that is reflected more often

  /// `beta_m` along and `beta_n` around the fibre, both in (0,1]. Scale tilt in degrees.
  HairShape(float beta_m, float beta_n, float scale_tilt_degrees);

  std::array<float, kLobes> v;  ///< longitudinal variance of each lobe
  float s;                      ///< scale of the azimuthal logistic
  /// Sines and cosines of -2a, a and 4a, which tilted scales add to theta_o for R, TT and TRT.
  std::array<float, 3> sin_tilt{}, cos_tilt{};
};

/// Local frame: x along the fibre, z the shading normal. Only the angle around x matters.
class HairBsdf final : public Bsdf {
 public:
  /// `h` in [-1,1]: where the ray wo meets the width of the fibre, growing along y for a ray along
  /// z. `eta` > 0. `sigma_a` >= 0 is absorption per fibre radius.
  HairBsdf(float h, float eta, const SampledSpectrum& sigma_a, const HairShape& shape);

  ClassMask classes() const override { return ClassMask::kDiffuse; }
  ClassMask finite_classes() const override { return ClassMask::kDiffuse; }
  /// The same in both modes: h belongs to the ray that arrived, whichever way light travels.
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f& wo) const override;

 private:
  static constexpr int kLobes = HairShape::kLobes;

  /// Quantities that depend on wo alone.
  struct Outgoing {
    float sin_theta = 0, cos_theta = 1, phi = 0;  ///< longitude and azimuth of wo
    float gamma_t = 0;                            ///< refraction angle in the cross section
    std::array<SampledSpectrum, kLobes> attenuation;
    std::array<float, kLobes> pdf_p{};                     ///< probability of choosing each lobe
    std::array<float, kLobes> sin_tilted{}, cos_tilted{};  ///< theta_o tilted by the scales
  };
  Outgoing outgoing(const Vec3f& wo) const;
  BsdfEval eval(const Outgoing& o, const Vec3f& wi) const;
  /// Change of azimuth in lobe p for a ray refracted without roughness.
  float azimuth(int p, float gamma_t) const;

  float h_, gamma_o_, eta_;
  SampledSpectrum sigma_a_;
  HairShape shape_;
};

}  // namespace nephroid
