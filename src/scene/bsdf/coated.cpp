// Lobes and sampling of coated surfaces in general; see coated.h.
#include "scene/bsdf/coated.h"

#include <type_traits>

namespace nephroid {
namespace {

/// Cosine inside the coat for light that enters at cosine c (clamped to at least 1e-3).
float cos_inside(float c, float eta) {
  return safe_sqrt(std::max(1e-6f, 1.0f - (1.0f - c * c) / sqr(eta)));
}

template <class Base>
constexpr bool kMetal = std::is_same_v<Base, ConductorSurface>;

template <class Base>
EventClass base_class(const Coat& coat, const Base& base, float specular_alpha) {
  if constexpr (kMetal<Base>) {
    if (!coat.scatters)
      return coat.boundary.event_class(specular_alpha) == EventClass::kSpecular
                 ? base.facets.event_class(specular_alpha)
                 : EventClass::kGlossy;
  }
  return EventClass::kDiffuse;
}

}  // namespace

template <class Base>
CoatedBsdf<Base>::CoatedBsdf(const Coat& coat, const Base& base, float specular_alpha)
    : coat_(coat),
      base_(base),
      coat_class_(coat.boundary.event_class(specular_alpha)),
      base_class_(base_class(coat, base, specular_alpha)),
      all_smooth_(coat.boundary.smooth() && base.smooth()),
      base_has_finite_(!all_smooth_ || coat.scatters) {}

template <class Base>
ClassMask CoatedBsdf<Base>::classes() const {
  ClassMask m = finite_classes();
  if (coat_.boundary.eta != 1.0f || all_smooth_) m = m | mask_of(coat_class_);
  return m;
}

template <class Base>
ClassMask CoatedBsdf<Base>::finite_classes() const {
  ClassMask m = ClassMask::kNone;
  if (!coat_.boundary.smooth()) m = m | mask_of(coat_class_);
  if (base_has_finite_) m = m | mask_of(base_class_);
  return m;
}

template <class Base>
SampledSpectrum CoatedBsdf<Base>::base_albedo(float c) const {
  if constexpr (kMetal<Base>)
    return base_.fresnel(c);
  else
    return base_.reflectance;
}

template <class Base>
typename CoatedBsdf<Base>::Shares CoatedBsdf<Base>::shares(const Vec3f& wo, ClassMask among) const {
  const float r = coat_.boundary.fresnel(wo);
  const float inside = cos_inside(wo.z, coat_.boundary.eta);
  const float base = (1.0f - r) * base_albedo(inside).max_component();
  float coat_energy = 0.0f, base_energy = 0.0f;
  if (contains(classes() & among, coat_class_) && (coat_.boundary.eta != 1.0f || all_smooth_))
    coat_energy = all_smooth_ ? r + base : r;
  if (base_has_finite_ && contains(among, base_class_))
    // Facets and media can return light where the smooth estimate sees none.
    base_energy = std::max(all_smooth_ ? 0.0f : base, 0.05f);
  const float sum = coat_energy + base_energy;
  if (!(sum > 0.0f)) return {};

  Shares p;
  p.coat = coat_energy / sum;
  if (coat_energy > 0.0f && base_energy > 0.0f) p.coat = std::clamp(p.coat, 0.05f, 0.95f);
  const float rest = 1.0f - p.coat;
  p.cosine = rest;
  if constexpr (kMetal<Base>) {
    if (!all_smooth_) {
      const float broad =
          std::min(0.8f, 0.1f + 0.4f * widened(wo).max_alpha() + (coat_.scatters ? 0.3f : 0.0f));
      p.cosine = rest * broad;
      p.lobe = rest - p.cosine;
    }
  }
  return p;
}

template <class Base>
TrowbridgeReitz CoatedBsdf<Base>::widened(const Vec3f& wo) const {
  if constexpr (kMetal<Base>) {
    // Slope variances add up: those of the base and, scaled by how much refraction turns light,
    // those of the coat's two crossings. A half vector inside looks steeper from outside.
    const float eta = coat_.boundary.eta;
    const float turn = 0.5f * sqr(1.0f - 1.0f / eta);
    const TrowbridgeReitz& coat = coat_.boundary.facets;
    const float coat_x = coat.smooth() ? 0.0f : turn * sqr(coat.alpha_x());
    const float coat_y = coat.smooth() ? 0.0f : turn * sqr(coat.alpha_y());
    const float base_x = base_.smooth() ? 0.0f : sqr(base_.facets.alpha_x());
    const float base_y = base_.smooth() ? 0.0f : sqr(base_.facets.alpha_y());
    const float steeper = eta * cos_inside(wo.z, eta) / std::max(wo.z, 1e-3f);
    return {std::clamp(steeper * std::sqrt(base_x + coat_x), 1.5e-3f, 1.0f),
            std::clamp(steeper * std::sqrt(base_y + coat_y), 1.5e-3f, 1.0f)};
  } else {
    return {1.0f, 1.0f};
  }
}

template <class Base>
float CoatedBsdf<Base>::lobe_pdf_w(const Vec3f& wo, const Vec3f& wi) const {
  return widened(wo).reflection_pdf_w(wo, normalize(wo + wi));
}

template <class Base>
BsdfEval CoatedBsdf<Base>::eval_above(const Vec3f& wo, const Vec3f& wi, TransportMode mode,
                                      EventClass c, const Shares& p) const {
  BsdfEval e;
  if (c == base_class_ && base_has_finite_) {
    e.f = layered_base_value(coat_, base_, wo, wi, mode);
    e.pdf_w = p.cosine * wi.z * kInvPi;
    if (p.lobe > 0.0f) e.pdf_w += p.lobe * lobe_pdf_w(wo, wi);
  }
  if (c == coat_class_ && !coat_.boundary.smooth()) {
    const auto v = coat_.boundary.evaluate(wo, wi, mode, BoundaryPart::kReflection);
    e.f += SampledSpectrum(v.f);
    e.pdf_w += p.coat * v.pdf_w;
  }
  return e;
}

template <class Base>
BsdfEval CoatedBsdf<Base>::eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                                ClassMask among) const {
  if (!contains(among & finite_classes(), c) || wo.z == 0.0f || wi.z == 0.0f ||
      (wo.z > 0.0f) != (wi.z > 0.0f))
    return {};
  const float side = wo.z > 0.0f ? 1.0f : -1.0f;
  const Vec3f o = wo * side, i = wi * side;
  return eval_above(o, i, mode, c, shares(o, among));
}

template <class Base>
SampledSpectrum CoatedBsdf<Base>::mirrored_by_base(const Vec3f& wo) const {
  // Light enters, is reflected by the base k times and by the coat k - 1 times, and leaves. The
  // radiance factors of the two crossings cancel.
  const float eta = coat_.boundary.eta;
  if (1.0f - wo.z * wo.z >= sqr(eta)) return {};
  const float r = coat_.boundary.fresnel(wo);
  const Vec3f inside(0, 0, cos_inside(wo.z, eta));
  const float across = sqr(Coat::transmittance(coat_.thickness, inside));
  const SampledSpectrum round = base_albedo(inside.z) * across;
  SampledSpectrum sum, term = round * sqr(1.0f - r);
  for (int k = 0; k < coat_.max_depth / 2 && term.max_component() > 1e-8f; ++k) {
    sum += term;
    term *= round * r;
  }
  return sum;
}

template <class Base>
std::optional<BsdfSample> CoatedBsdf<Base>::sample(const Vec3f& wo_any, float uc, const Vec2f& u,
                                                   TransportMode mode, ClassMask among) const {
  if (wo_any.z == 0.0f) return std::nullopt;
  const float side = wo_any.z > 0.0f ? 1.0f : -1.0f;
  const Vec3f wo = wo_any * side;
  const Shares p = shares(wo, among);
  if (!(p.coat + p.lobe + p.cosine > 0.0f)) return std::nullopt;

  BsdfSample s;
  if (uc < p.coat) {
    s.event = coat_class_;
    if (coat_.boundary.smooth()) {
      s.wi = Vec3f(-wo.x, -wo.y, wo.z);
      s.f = SampledSpectrum(coat_.boundary.fresnel(wo));
      if (all_smooth_) s.f += mirrored_by_base(wo);
      s.f /= s.wi.z;
      s.pdf_w = p.coat;
      s.delta = true;
    } else {
      const auto mirrored = coat_.boundary.sample(wo, 0.0f, u, mode, BoundaryPart::kReflection);
      if (!mirrored) return std::nullopt;
      s.wi = mirrored->wi;
    }
  } else {
    s.event = base_class_;
    s.wi = uc < p.coat + p.lobe ? normalize(reflect_about(wo, widened(wo).sample_visible(wo, u)))
                                : square_to_cosine_hemisphere(u);
  }
  if (!(s.wi.z > 0.0f)) return std::nullopt;
  if (!s.delta) {
    const BsdfEval e = eval_above(wo, s.wi, mode, s.event, p);
    s.f = e.f;  // can be black: it is an estimate, and the walk goes on
    s.pdf_w = e.pdf_w;
  }
  if (!(s.pdf_w > 0.0f)) return std::nullopt;
  s.wi *= side;
  return s;
}

template <class Base>
SampledSpectrum CoatedBsdf<Base>::albedo(const Vec3f& wo) const {
  const float c = std::abs(wo.z), r = fresnel_dielectric(c, coat_.boundary.eta);
  return SampledSpectrum(r) + base_albedo(cos_inside(c, coat_.boundary.eta)) * (1.0f - r);
}

template class CoatedBsdf<LambertSurface>;
template class CoatedBsdf<ConductorSurface>;

}  // namespace nephroid
