// Value, density and sampling of metals; see conductor.h.
#include "scene/bsdf/conductor.h"

namespace nephroid {

ConductorSurface::Value ConductorSurface::evaluate(const Vec3f& wo, const Vec3f& wi) const {
  Value v;
  if (smooth() || wo.z == 0.0f || wi.z == 0.0f || (wo.z > 0.0f) != (wi.z > 0.0f)) return v;
  Vec3f m = wo + wi;
  if (!(length_squared(m) > 0.0f)) return v;
  m = normalize(m);
  const float zo = std::abs(wo.z), zi = std::abs(wi.z);
  const float d = facets.d(m), so = facets.s(wo), si = facets.s(wi);
  v.f = fresnel(abs_dot(wo, m)) * (d * TrowbridgeReitz::g2_over_4zz(so, zo, si, zi));
  v.pdf_w = 0.5f * d / (zo + so);
  return v;
}

std::optional<ConductorSurface::Sample> ConductorSurface::sample(const Vec3f& wo,
                                                                 const Vec2f& u) const {
  if (wo.z == 0.0f) return std::nullopt;
  Sample s;
  if (smooth()) {
    s.wi = Vec3f(-wo.x, -wo.y, wo.z);
    s.weight = fresnel(abs_cos_theta(wo));
    s.pdf_w = 1.0f;
    return s;
  }
  const Vec3f m = facets.sample_visible(wo, u);
  s.wi = normalize(reflect_about(wo, m));
  if (s.wi.z == 0.0f || (wo.z > 0.0f) != (s.wi.z > 0.0f)) return std::nullopt;
  const float zo = std::abs(wo.z), zi = std::abs(s.wi.z);
  const float so = facets.s(wo), si = facets.s(s.wi);
  s.pdf_w = 0.5f * facets.d(m) / (zo + so);
  s.weight = fresnel(abs_dot(wo, m)) * (zi * (zo + so) / (so * zi + si * zo));
  return s;
}

BsdfEval ConductorBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode, EventClass c,
                             ClassMask among) const {
  if (c != class_ || !contains(among, c)) return {};
  const ConductorSurface::Value v = surface_.evaluate(wo, wi);
  return {v.f, v.pdf_w};
}

std::optional<BsdfSample> ConductorBsdf::sample(const Vec3f& wo, float, const Vec2f& u,
                                                TransportMode, ClassMask among) const {
  if (!contains(among, class_)) return std::nullopt;
  const auto chosen = surface_.sample(wo, u);
  if (!chosen) return std::nullopt;
  BsdfSample s;
  s.wi = chosen->wi;
  s.pdf_w = chosen->pdf_w;
  s.f = chosen->weight * (s.pdf_w / abs_cos_theta(s.wi));
  s.event = class_;
  s.delta = surface_.smooth();
  return s;
}

}  // namespace nephroid
