// Value, density and sampling; see normalized_fresnel.h.
#include "scene/bsdf/normalized_fresnel.h"

#include "core/warps.h"
#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/fresnel_moments.h"

namespace nephroid {

NormalizedFresnelBsdf::NormalizedFresnelBsdf(float eta)
    : eta_(eta), scale_(kInvPi / static_cast<float>(1.0 - 2.0 * fresnel_moment_1(1.0 / eta))) {}

float NormalizedFresnelBsdf::f(const Vec3f& wi, TransportMode mode) const {
  const float through = (1.0f - fresnel_dielectric(wi.z, eta_)) * scale_;
  return mode == TransportMode::kRadiance ? through * sqr(eta_) : through;
}

BsdfEval NormalizedFresnelBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode,
                                     EventClass c, ClassMask among) const {
  if (c != EventClass::kDiffuse || !contains(among, c) || !(wo.z > 0.0f) || !(wi.z > 0.0f))
    return {};
  return {SampledSpectrum(f(wi, mode)), wi.z * kInvPi};
}

std::optional<BsdfSample> NormalizedFresnelBsdf::sample(const Vec3f& wo, float, const Vec2f& u,
                                                        TransportMode mode, ClassMask among) const {
  if (!(wo.z > 0.0f) || !contains(among, EventClass::kDiffuse)) return std::nullopt;
  BsdfSample s;
  s.wi = square_to_cosine_hemisphere(u);
  if (!(s.wi.z > 0.0f)) return std::nullopt;
  s.pdf_w = s.wi.z * kInvPi;
  s.f = SampledSpectrum(f(s.wi, mode));
  return s;
}

}  // namespace nephroid
