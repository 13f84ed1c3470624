// Scattering by a hair fibre, a rough dielectric cylinder with absorption inside: Chiang, Bitterli,
// Tappan & Burley 2016, "A practical and controllable hair and fur model for production path
// tracing", on the lobes of d'Eon et al. 2011; conventions of angles, scales and roughness as in
// pbrt-v4 section 9.9. All lobes are class D and reach the whole sphere; the
// letter of its events is H.
// Who calls it: the hair material. It must not know curves, textures or pigments.
#pragma once

#include <array>

#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// What the roughness and the tilt of the scales say, without colour and place.
struct HairShape {
  static constexpr int kLobes = 4;  ///< R, TT, TRT, and all that is reflected more often

  /// `beta_m` along and `beta_n` around the fibre, both in (0,1]; tilt of the scales in degrees.
  HairShape(float beta_m, float beta_n, float scale_tilt_degrees);

  std::array<float, kLobes> v;  ///< variances along the fibre
  float s;                      ///< scale of the logistic around the fibre
  /// Of the angles -2a, a and 4a that tilted scales add to theta_o for R, TT and TRT.
  std::array<float, 3> sin_tilt{}, cos_tilt{};
};

/// Local frame: x along the fibre, z the shading normal; what counts is the angle around x.
class HairBsdf final : public Bsdf {
 public:
  /// `h` in [-1,1] is where the ray wo meets the width of the fibre, growing along y for a ray that
  /// runs along z. `eta` > 0. `sigma_a` is absorption per radius of the fibre, at least 0.
  HairBsdf(float h, float eta, const SampledSpectrum& sigma_a, const HairShape& shape);

  ClassMask classes() const override { return ClassMask::kDiffuse; }
  ClassMask finite_classes() const override { return ClassMask::kDiffuse; }
  /// The same in both modes: the place h belongs to the ray that arrived, whichever way light runs.
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f& wo) const override;

 private:
  static constexpr int kLobes = HairShape::kLobes;

  /// What follows from wo alone.
  struct Outgoing {
    float sin_theta = 0, cos_theta = 1, phi = 0;  ///< longitude and azimuth of wo
    float gamma_t = 0;                            ///< angle of refraction in the cross section
    std::array<SampledSpectrum, kLobes> attenuation;
    std::array<float, kLobes> pdf_p{};                     ///< probability of choosing each lobe
    std::array<float, kLobes> sin_tilted{}, cos_tilted{};  ///< theta_o turned by the scales
  };
  Outgoing outgoing(const Vec3f& wo) const;
  BsdfEval eval(const Outgoing& o, const Vec3f& wi) const;
  /// Change of azimuth of a ray that is refracted without roughness, lobe p.
  float azimuth(int p, float gamma_t) const;

  float h_, gamma_o_, eta_;
  SampledSpectrum sigma_a_;
  HairShape shape_;
};

}  // namespace nephroid
