// A Lambertian base under a dielectric coat whose gap only absorbs: layered_walk.h in closed form.
//   f(wo, wi) = rho/pi * tau(wo) tau(wi) / eta^2 * sum_{k<K} (rho R)^k
// tau: flux through coat and gap to the base. R: share of the base's diffuse light that the coat
// returns, gap included. K: most meetings with the base. It must not know textures.
#pragma once

#include <array>

#include "scene/bsdf/dielectric.h"

namespace nephroid {

/// tau and R of one coat, computed once. Isotropic facets only.
class CoatTable {
 public:
  CoatTable(const DielectricInterface& boundary, float thickness, int max_depth);

  const DielectricInterface& boundary() const { return boundary_; }
  /// tau at cosine c >= 0.
  float transmission(float c) const;
  /// Share of flux that the coat alone reflects at cosine c >= 0 (from tables if rough).
  float reflection(float c) const;
  /// R of the file's head.
  float inner_reflectance() const { return inner_reflectance_; }
  /// 2 * integral of tau(c) c dc: transmission of diffuse light.
  float diffuse_transmission() const { return diffuse_transmission_; }
  /// sum_{k<K} (rho R)^k.
  SampledSpectrum bounces(const SampledSpectrum& rho) const;

 private:
  static constexpr int kNodes = 64;
  float smooth_transmission(float c) const;
  /// Values at equal steps of the square root of the cosine, where curvature is least.
  using Table = std::array<float, kNodes + 1>;
  static float look_up(const Table& table, float c);
  void fill_rough_tables();

  DielectricInterface boundary_;
  float thickness_;
  int base_bounces_;
  float inner_reflectance_ = 0, diffuse_transmission_ = 0;
  Table transmission_{}, reflection_{};
};

/// Two classes: the coat's own reflection is S or G by the coat's roughness, the rest is D.
/// Both sides alike, opaque. `table` outlives the BSDF.
class CoatedDiffuseBsdf final : public Bsdf {
 public:
  CoatedDiffuseBsdf(const CoatTable* table, const SampledSpectrum& reflectance,
                    float specular_alpha);

  ClassMask classes() const override {
    return has_coat_lobe_ ? ClassMask::kDiffuse | mask_of(coat_class_) : ClassMask::kDiffuse;
  }
  ClassMask finite_classes() const override {
    return coat_is_delta_ ? ClassMask::kDiffuse : classes();
  }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f& wo) const override;

 private:
  struct Shares {
    float coat = 0, base = 0;
  };
  /// Probabilities of the two lobes; they sum to 1, or are both 0 if `among` has neither.
  Shares shares(float cos_o, float tau_o, ClassMask among) const;
  BsdfEval eval_above(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                      const Shares& p, float tau_o) const;

  const CoatTable* table_;
  SampledSpectrum base_;  ///< rho / (pi eta^2) * bounces
  float base_energy_;     ///< pi * maximum of base_ * diffuse transmission
  EventClass coat_class_;
  bool has_coat_lobe_, coat_is_delta_;
};

}  // namespace nephroid
