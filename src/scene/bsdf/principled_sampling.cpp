// Sampling of the principled BSDF; see principled.h.
#include "core/warps.h"
#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/principled.h"

namespace nephroid {
namespace {

/// `side`: the sign of the direction's cosine.
Vec3f uniform_hemisphere(const Vec2f& u, float side) {
  const float r = safe_sqrt(1.0f - u.x * u.x), phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), u.x * side};
}
Vec3f cosine_hemisphere(const Vec2f& u, float side) {
  const Vec3f w = square_to_cosine_hemisphere(u);
  return {w.x, w.y, w.z * side};
}

/// A direction with a uniform square root of its cosine.
Vec3f grazing_hemisphere(const Vec2f& u, float side) {
  return uniform_hemisphere({u.x * u.x, u.y}, side);
}

}  // namespace

std::optional<BsdfSample> PrincipledBsdf::sample(const Vec3f& wo, float uc, const Vec2f& u,
                                                 TransportMode mode, ClassMask among) const {
  if (wo.z == 0.0f) return std::nullopt;
  const View v = view(wo, among);
  int lobe = 0;
  while (lobe < kLobes && !(uc < v.shares[lobe])) uc -= v.shares[lobe++];
  if (lobe == kLobes) {
    // Rounding left over some uc: take the last lobe.
    do --lobe;
    while (lobe >= 0 && !(v.shares[lobe] > 0.0f));
    if (lobe < 0) return std::nullopt;
    uc = v.shares[lobe] * kOneMinusEpsilon;
  }
  uc = std::min(uc / v.shares[lobe], kOneMinusEpsilon);

  BsdfSample s;
  switch (static_cast<Lobe>(lobe)) {
    case kFuzz:
      s.wi = uniform_hemisphere(u, v.side);
      break;
    case kDiffuse:
      s.wi = uc < uniform_share() ? uniform_hemisphere(u, v.side) : cosine_hemisphere(u, v.side);
      break;
    case kDiffuseThrough:
      s.wi = cosine_hemisphere(u, -v.side);
      break;
    case kMultiple:
      s.wi = grazing_hemisphere(u, v.side);
      s.event = facet_class_;
      break;
    case kCoat:
      return sample_coat(v, u);
    case kFacets:
      return sample_facets(v, uc, u, mode);
    case kSubsurface:
      return enter(v);
    case kStraight:
      return go_straight(v);
    case kLobes:
      return std::nullopt;
  }
  return finish(v, s, mode);
}

std::optional<BsdfSample> PrincipledBsdf::finish(const View& v, BsdfSample s,
                                                 TransportMode mode) const {
  if (s.wi.z == 0.0f) return std::nullopt;
  s.transmitted = s.wi.z * v.side < 0.0f;
  s.eta = eta_between(v.wo, s.wi);
  const BsdfEval e = evaluate(v, s.wi, mode, s.event);
  if (!(e.pdf_w > 0.0f)) return std::nullopt;
  s.f = e.f;
  s.pdf_w = e.pdf_w;
  return s;
}

std::optional<BsdfSample> PrincipledBsdf::sample_coat(const View& v, const Vec2f& u) const {
  BsdfSample s;
  s.event = coat_class_;
  if (!s_.coat_facets.smooth()) {
    s.wi = normalize(reflect_about(v.up, s_.coat_facets.sample_visible(v.up, u))) * v.side;
    if (s.wi.z * v.side <= 0.0f) return std::nullopt;
    return finish(v, s, TransportMode::kRadiance);  // reflection is the same in both modes
  }
  const float outside = v.inside ? 1.0f - s_.transmitting() : 1.0f;
  s.wi = Vec3f(-v.wo.x, -v.wo.y, v.wo.z);
  s.f = SampledSpectrum(outside * v.passed.fuzz * layers_->coat_fresnel(v.up.z) / v.up.z);
  s.pdf_w = v.shares[kCoat];
  s.delta = true;
  return s;
}

std::optional<BsdfSample> PrincipledBsdf::sample_facets(const View& v, float uc, const Vec2f& u,
                                                        TransportMode mode) const {
  if (s_.facets.smooth()) return sample_mirror(v, uc, mode);
  const std::optional<Vec3f> wi = sample_rough(v, uc, u);
  if (!wi) return std::nullopt;
  BsdfSample s;
  s.event = facet_class_;
  s.wi = *wi;
  return finish(v, s, mode);
}

std::optional<Vec3f> PrincipledBsdf::sample_rough(const View& v, float uc, const Vec2f& u) const {
  const Vec3f m = s_.facets.sample_visible(v.wo, u);
  const float om = dot(v.wo, m);
  const bool reflects = uc < reflection_share(v, std::abs(om));
  if (reflects || s_.thin_walled) {
    const Vec3f wi = normalize(reflect_about(v.wo, m));
    if (!(wi.z * v.side > 0.0f)) return std::nullopt;
    return reflects ? wi : Vec3f(wi.x, wi.y, -wi.z);
  }
  Vec3f wi;
  float eta;
  if (!refract_about(v.wo, m, s_.ior, &wi, &eta)) return std::nullopt;
  wi = normalize(wi);
  if (!(wi.z * v.side < 0.0f)) return std::nullopt;
  return wi;
}

std::optional<BsdfSample> PrincipledBsdf::sample_mirror(const View& v, float uc,
                                                        TransportMode mode) const {
  const float c = v.up.z, coat = joined_coat(v);
  SampledSpectrum r = facet_reflectance(v, v.passed, c) + SampledSpectrum(coat);
  SampledSpectrum t;
  BsdfSample s;
  s.event = facet_class_;
  s.delta = true;
  const bool refracted = facets_transmit_ &&
                         refract_about(v.wo, Vec3f(0, 0, 1), s_.ior, &s.wi, &s.eta) &&
                         s.wi.z * v.side < 0.0f;
  if (refracted) {
    s.wi = normalize(s.wi);
    t = facet_transmittance(v, v.inside ? layers_->passed(s.wi) : v.passed, c);
  }
  const float sum = r.average() + t.average();
  if (!(sum > 0.0f)) return std::nullopt;
  const float share = r.average() / sum;
  if (uc < share) {
    s.wi = Vec3f(-v.wo.x, -v.wo.y, v.wo.z);
    s.eta = 1.0f;
    s.f = r / c;
    s.pdf_w = v.shares[kFacets] * share;
    return s;
  }
  if (!refracted) return std::nullopt;
  s.transmitted = true;
  s.f = t / abs_cos_theta(s.wi);
  if (mode == TransportMode::kRadiance) s.f /= sqr(s.eta);
  s.pdf_w = v.shares[kFacets] * (1.0f - share);
  return s;
}

BsdfSample PrincipledBsdf::enter(const View& v) const {
  // No factor 1 / eta^2 for radiance here, since the exit has no inverse factor.
  BsdfSample s;
  s.wi = -v.wo;
  s.pdf_w = v.shares[kSubsurface];
  s.f = subsurface_share_ * v.base / v.up.z;
  s.eta = eta_between(v.wo, s.wi);
  s.transmitted = s.subsurface = s.delta = true;
  return s;
}

BsdfSample PrincipledBsdf::go_straight(const View& v) const {
  BsdfSample s;
  s.wi = -v.wo;
  s.pdf_w = v.shares[kStraight];
  s.f = straight_transmittance(v.wo) / v.up.z;
  s.event = EventClass::kSpecular;
  s.transmitted = s.delta = s.straight_through = true;
  return s;
}

std::optional<std::array<BsdfSample, 2>> PrincipledBsdf::delta_pair(const Vec3f& wo,
                                                                    TransportMode mode) const {
  if (classes_ != ClassMask::kSpecular || finite_classes_ != ClassMask::kNone ||
      !facets_transmit_ || wo.z == 0.0f)
    return std::nullopt;
  const View v = view(wo, ClassMask::kSpecular);
  if (v.shares[kFacets] != 1.0f) return std::nullopt;
  // uc = 0 reflects and the largest uc refracts, unless one of them has probability 0.
  const auto a = sample_mirror(v, 0.0f, mode);
  const auto b = sample_mirror(v, kOneMinusEpsilon, mode);
  if (!a || !b || a->transmitted == b->transmitted) return std::nullopt;
  return std::array<BsdfSample, 2>{*a, *b};
}

}  // namespace nephroid
