// Light that scatters below a principled surface: a tabulated profile. The light leaves through the
// same layers by which it entered. It must not know shapes.
#pragma once

#include "scene/bsdf/principled_layers.h"
#include "scene/bsdf/tabulated_bssrdf.h"

namespace nephroid {

/// The exit of light, of class D. wo is along the normal, so the value depends on wi only. All
/// light leaves.
class PrincipledExitBsdf final : public Bsdf {
 public:
  explicit PrincipledExitBsdf(const PrincipledLayers* layers) : layers_(layers) {}

  ClassMask classes() const override { return ClassMask::kDiffuse; }
  ClassMask finite_classes() const override { return ClassMask::kDiffuse; }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f&) const override { return SampledSpectrum(1.0f); }

 private:
  SampledSpectrum f(const Vec3f& wi) const;

  const PrincipledLayers* layers_;
};

class PrincipledBssrdf final : public Bssrdf {
 public:
  /// `layers` lives as long as the arena that exit_bsdf() gets.
  PrincipledBssrdf(const TabulatedBssrdf& profile, const PrincipledLayers* layers)
      : profile_(profile), layers_(layers) {}

  std::optional<BssrdfProbe> sample_probe(float u_axis, const Vec2f& u) const override {
    return profile_.sample_probe(u_axis, u);
  }
  SampledSpectrum sp(const Vec3f& p) const override { return profile_.sp(p); }
  float pdf_a(const Vec3f& p, const Vec3f& ng) const override { return profile_.pdf_a(p, ng); }
  const Bsdf* exit_bsdf(BsdfArena& arena) const override {
    return arena.make<PrincipledExitBsdf>(layers_);
  }

 private:
  TabulatedBssrdf profile_;
  const PrincipledLayers* layers_;
};

}  // namespace nephroid
