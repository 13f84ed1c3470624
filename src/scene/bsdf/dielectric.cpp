// Value, density and sampling of dielectric boundaries and panes; see dielectric.h.
#include "scene/bsdf/dielectric.h"

namespace nephroid {
namespace {

/// Probability that sample() reflects at a facet of reflectance r.
float reflection_share(float r, BoundaryPart part) {
  if (part == BoundaryPart::kReflection) return 1.0f;
  return part == BoundaryPart::kTransmission ? 0.0f : r;
}

std::optional<DielectricInterface::Sample> sample_smooth(const DielectricInterface& boundary,
                                                         const Vec3f& wo, float uc,
                                                         TransportMode mode, BoundaryPart part) {
  DielectricInterface::Sample s;
  const float r = boundary.fresnel(wo);
  const float share = reflection_share(r, part);
  if (uc < share) {
    s.wi = Vec3f(-wo.x, -wo.y, wo.z);
    s.weight = r / share;
    s.pdf_w = share;
    return s;
  }
  if (r >= 1.0f) return std::nullopt;
  if (!refract_about(wo, Vec3f(0, 0, 1), boundary.eta, &s.wi, &s.eta)) return std::nullopt;
  s.wi = normalize(s.wi);
  if (s.wi.z == 0.0f || same_side(wo, s.wi)) return std::nullopt;
  s.transmitted = true;
  s.pdf_w = 1.0f - share;
  s.weight = (1.0f - r) / s.pdf_w;
  if (mode == TransportMode::kRadiance) s.weight /= sqr(s.eta);
  return s;
}

}  // namespace

DielectricInterface::Value DielectricInterface::evaluate(const Vec3f& wo, const Vec3f& wi,
                                                         TransportMode mode,
                                                         BoundaryPart part) const {
  Value v;
  if (smooth() || wo.z == 0.0f || wi.z == 0.0f) return v;
  const bool reflects = same_side(wo, wi);
  const float eta_path = eta_between(wo, wi);
  Vec3f m = wi * eta_path + wo;
  if (!(length_squared(m) > 0.0f)) return v;
  m = normalize(m);
  if (m.z < 0.0f) m = -m;
  const float om = dot(wo, m), im = dot(wi, m);
  // Facets seen from behind do not scatter.
  if (om * wo.z <= 0.0f || im * wi.z <= 0.0f) return v;

  const float r = fresnel_dielectric(om, eta);
  const float zo = std::abs(wo.z), zi = std::abs(wi.z);
  const float d = facets.d(m), so = facets.s(wo), si = facets.s(wi);
  const float g = TrowbridgeReitz::g2_over_4zz(so, zo, si, zi);
  const float share = reflection_share(r, part);
  if (reflects) {
    v.f = d * g * r;
    v.pdf_w = 0.5f * d / (zo + so) * share;
    return v;
  }
  const float denominator = sqr(im + om / eta_path);
  if (!(denominator > 0.0f)) return v;
  const float jacobian = std::abs(im * om) / denominator;
  v.f = 4.0f * d * g * (1.0f - r) * jacobian;
  if (mode == TransportMode::kRadiance) v.f /= sqr(eta_path);
  v.pdf_w = 2.0f * d / (zo + so) * jacobian * (1.0f - share);
  return std::isfinite(v.f) && std::isfinite(v.pdf_w) ? v : Value{};
}

std::optional<DielectricInterface::Sample> DielectricInterface::sample(const Vec3f& wo, float uc,
                                                                       const Vec2f& u,
                                                                       TransportMode mode,
                                                                       BoundaryPart part) const {
  if (wo.z == 0.0f) return std::nullopt;
  if (smooth()) return sample_smooth(*this, wo, uc, mode, part);

  const Vec3f m = facets.sample_visible(wo, u);
  const float om = dot(wo, m);
  const float r = fresnel_dielectric(om, eta);
  const float share = reflection_share(r, part);
  const float zo = std::abs(wo.z), so = facets.s(wo), d = facets.d(m);
  Sample s;
  if (uc < share) {
    s.wi = normalize(reflect_about(wo, m));
    if (s.wi.z == 0.0f || !same_side(wo, s.wi)) return std::nullopt;
    s.pdf_w = 0.5f * d / (zo + so) * share;
    s.weight = r / share;
  } else {
    if (r >= 1.0f || !refract_about(wo, m, eta, &s.wi, &s.eta)) return std::nullopt;
    s.wi = normalize(s.wi);
    if (s.wi.z == 0.0f || same_side(wo, s.wi)) return std::nullopt;
    s.transmitted = true;
    const float im = dot(s.wi, m);
    const float denominator = sqr(im + om / s.eta);
    if (!(denominator > 0.0f)) return std::nullopt;
    s.pdf_w = 2.0f * d / (zo + so) * std::abs(im * om) / denominator * (1.0f - share);
    s.weight = (1.0f - r) / (1.0f - share);
    if (mode == TransportMode::kRadiance) s.weight /= sqr(s.eta);
  }
  const float zi = std::abs(s.wi.z), si = facets.s(s.wi);
  s.weight *= zi * (zo + so) / (so * zi + si * zo);
  if (!(s.pdf_w > 0.0f) || !std::isfinite(s.pdf_w)) return std::nullopt;
  return s;
}

BsdfEval DielectricBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                              ClassMask among) const {
  if (c != class_ || !contains(among, c)) return {};
  const DielectricInterface::Value v = boundary_.evaluate(wo, wi, mode, BoundaryPart::kBoth);
  return {SampledSpectrum(v.f), v.pdf_w};
}

std::optional<BsdfSample> DielectricBsdf::sample(const Vec3f& wo, float uc, const Vec2f& u,
                                                 TransportMode mode, ClassMask among) const {
  const bool nothing_there = boundary_.eta == 1.0f;
  if (!nothing_there && !contains(among, class_)) return std::nullopt;
  const auto chosen = boundary_.sample(wo, uc, u, mode, BoundaryPart::kBoth);
  if (!chosen) return std::nullopt;
  BsdfSample s;
  s.wi = nothing_there ? -wo : chosen->wi;
  s.pdf_w = chosen->pdf_w;
  s.f = SampledSpectrum(chosen->weight * (s.pdf_w / abs_cos_theta(s.wi)));
  s.eta = chosen->eta;
  s.event = class_;
  s.transmitted = chosen->transmitted;
  s.delta = boundary_.smooth();
  s.straight_through = nothing_there;
  return s;
}

std::optional<std::array<BsdfSample, 2>> DielectricBsdf::delta_pair(const Vec3f& wo,
                                                                    TransportMode mode) const {
  if (!boundary_.smooth() || boundary_.eta == 1.0f) return std::nullopt;
  // uc = 0 reflects and the largest uc refracts, unless one of them has probability 0.
  const auto a = sample(wo, 0.0f, Vec2f(0, 0), mode, ClassMask::kSpecular);
  const auto b = sample(wo, kOneMinusEpsilon, Vec2f(0, 0), mode, ClassMask::kSpecular);
  if (!a || !b || a->transmitted == b->transmitted) return std::nullopt;
  return std::array<BsdfSample, 2>{*a, *b};
}

SampledSpectrum ThinDielectricBsdf::pane_reflectance(float cos_i, const SampledSpectrum& eta) {
  return eta.map([c = std::abs(cos_i)](float e) {
    const float r = fresnel_dielectric(c, e);
    // r + t r t + t r r r t + ... with t = 1 - r.
    return r < 1.0f ? r + sqr(1.0f - r) * r / (1.0f - r * r) : 1.0f;
  });
}

std::optional<BsdfSample> ThinDielectricBsdf::sample(const Vec3f& wo, float uc, const Vec2f&,
                                                     TransportMode, ClassMask among) const {
  if (wo.z == 0.0f) return std::nullopt;
  const SampledSpectrum r = pane_reflectance(wo.z, eta_);
  const float share = contains(among, EventClass::kSpecular) ? r.average() : 0.0f;
  BsdfSample s;
  s.event = EventClass::kSpecular;
  s.delta = true;
  if (uc < share) {
    s.wi = Vec3f(-wo.x, -wo.y, wo.z);
    s.f = r / abs_cos_theta(wo);
    s.pdf_w = share;
    return s;
  }
  s.wi = -wo;
  s.f = (SampledSpectrum(1.0f) - r) / abs_cos_theta(wo);
  s.pdf_w = 1.0f - share;
  if (s.f.is_black() || !(s.pdf_w > 0.0f)) return std::nullopt;
  s.transmitted = true;
  s.straight_through = true;
  return s;
}

}  // namespace nephroid
