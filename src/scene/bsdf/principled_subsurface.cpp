// The exit of subsurface light through the layers; see principled_subsurface.h.
#include "scene/bsdf/principled_subsurface.h"

#include "core/warps.h"

namespace nephroid {

SampledSpectrum PrincipledExitBsdf::f(const Vec3f& wi) const {
  const SampledSpectrum reaches = layers_->reaches_base(wi, layers_->passed(wi));
  return layers_->couple(SampledSpectrum(1.0f), reaches) * kInvPi;
}

BsdfEval PrincipledExitBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode, EventClass c,
                                  ClassMask among) const {
  if (c != EventClass::kDiffuse || !contains(among, c) || !(wo.z > 0.0f) || !(wi.z > 0.0f))
    return {};
  return {f(wi), wi.z * kInvPi};
}

std::optional<BsdfSample> PrincipledExitBsdf::sample(const Vec3f& wo, float, const Vec2f& u,
                                                     TransportMode, ClassMask among) const {
  if (!(wo.z > 0.0f) || !contains(among, EventClass::kDiffuse)) return std::nullopt;
  BsdfSample s;
  s.wi = square_to_cosine_hemisphere(u);
  if (!(s.wi.z > 0.0f)) return std::nullopt;
  s.pdf_w = s.wi.z * kInvPi;
  s.f = f(s.wi);
  return s;
}

}  // namespace nephroid
