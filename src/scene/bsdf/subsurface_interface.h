// The boundary of a medium that is known by its Bssrdf only: it reflects as a dielectric does, and
// what goes through it becomes a `subsurface` event, whose direction nobody needs. Who calls it:
// the subsurface material. It must not know profiles.
#pragma once

#include "scene/bsdf/dielectric.h"

namespace nephroid {

/// Reflection has the class of its roughness, S or G. Going in is of class D, whatever the
/// roughness: the light comes out diffuse. It is told as a delta lobe, because no other technique
/// makes it.
class SubsurfaceInterfaceBsdf final : public Bsdf {
 public:
  SubsurfaceInterfaceBsdf(const DielectricInterface& boundary, float specular_alpha)
      : boundary_(boundary), reflection_(boundary.event_class(specular_alpha)) {}

  ClassMask classes() const override {
    return boundary_.eta == 1.0f ? ClassMask::kDiffuse : ClassMask::kDiffuse | mask_of(reflection_);
  }
  ClassMask finite_classes() const override {
    return boundary_.smooth() ? ClassMask::kNone : mask_of(reflection_);
  }
  /// Of reflection only.
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  /// For a subsurface event f |cos| / pdf_w is what the boundary lets through from wo, in kRadiance
  /// mode scaled by refraction, which the exit undoes; so its `eta` is 1.
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f&) const override { return SampledSpectrum(1.0f); }

 private:
  /// What sample() chooses from. Empty if `among` has no lobe.
  std::optional<BoundaryPart> part(ClassMask among) const;

  DielectricInterface boundary_;
  EventClass reflection_;
};

}  // namespace nephroid
