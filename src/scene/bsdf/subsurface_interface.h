// The boundary of a medium that is described by its Bssrdf only. It reflects like a dielectric;
// transmission becomes a `subsurface` event, whose direction is not used. It must not know
// profiles.
#pragma once

#include "scene/bsdf/dielectric.h"

namespace nephroid {

/// Reflection is S or G by its roughness. Entering is of class D whatever the roughness, since
/// light comes out diffuse. It is reported as a delta lobe, because no other technique creates it.
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
  /// Value and density of the reflection only.
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  /// For a subsurface event f |cos| / pdf_w is the transmitted share from wo. In kRadiance mode it
  /// includes the scaling by refraction, which the exit undoes, so `eta` is 1.
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f&) const override { return SampledSpectrum(1.0f); }

 private:
  /// The parts that sample() chooses from. Empty if `among` has no lobe.
  std::optional<BoundaryPart> part(ClassMask among) const;

  DielectricInterface boundary_;
  EventClass reflection_;
};

}  // namespace nephroid
