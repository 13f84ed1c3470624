// Reflection or a subsurface event; see subsurface_interface.h.
#include "scene/bsdf/subsurface_interface.h"

namespace nephroid {

std::optional<BoundaryPart> SubsurfaceInterfaceBsdf::part(ClassMask among) const {
  const bool reflects = contains(among, reflection_);
  const bool enters = contains(among, EventClass::kDiffuse);
  if (reflects && enters) return BoundaryPart::kBoth;
  if (reflects) return BoundaryPart::kReflection;
  if (enters) return BoundaryPart::kTransmission;
  return std::nullopt;
}

BsdfEval SubsurfaceInterfaceBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode,
                                       EventClass c, ClassMask among) const {
  if (c != reflection_ || !contains(among, c) || !same_hemisphere(wo, wi)) return {};
  const DielectricInterface::Value v = boundary_.evaluate(wo, wi, mode, *part(among));
  return {SampledSpectrum(v.f), v.pdf_w};
}

std::optional<BsdfSample> SubsurfaceInterfaceBsdf::sample(const Vec3f& wo, float uc, const Vec2f& u,
                                                          TransportMode mode,
                                                          ClassMask among) const {
  const std::optional<BoundaryPart> wanted = part(among);
  if (!wanted) return std::nullopt;
  const auto chosen = boundary_.sample(wo, uc, u, mode, *wanted);
  if (!chosen || !(chosen->weight > 0.0f)) return std::nullopt;
  BsdfSample s;
  s.wi = chosen->wi;
  s.pdf_w = chosen->pdf_w;
  s.f = SampledSpectrum(chosen->weight * (s.pdf_w / abs_cos_theta(s.wi)));
  s.transmitted = s.subsurface = chosen->transmitted;
  s.event = s.subsurface ? EventClass::kDiffuse : reflection_;
  s.delta = s.subsurface || boundary_.smooth();
  return s;
}

}  // namespace nephroid
