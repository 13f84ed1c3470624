// Lobes, values and densities of the principled BSDF; see principled.h.
#include "scene/bsdf/principled.h"

#include "core/warps.h"
#include "scene/bsdf/fresnel.h"

namespace nephroid {
namespace {

/// Minimum energy of a lobe that exists: the estimate for one facet can be 0 where the lobe is not.
constexpr float kMinEnergy = 0.02f;

}  // namespace

PrincipledBsdf::PrincipledBsdf(const PrincipledLayers* layers, float specular_alpha)
    : layers_(layers),
      s_(layers->surface()),
      diffuse_(s_.diffuse_color, s_.diffuse_roughness),
      diffuse_share_(layers->diffuse_darkening(s_.diffuse_color) *
                     (s_.opaque() * (1.0f - s_.subsurface) * (1.0f - s_.diffuse_transmission))),
      through_share_(layers->diffuse_darkening(s_.diffuse_transmission_color) *
                     s_.diffuse_transmission_color *
                     (s_.opaque() * (1.0f - s_.subsurface) * s_.diffuse_transmission)),
      subsurface_share_(layers->diffuse_darkening(s_.subsurface_color) *
                        (s_.opaque() * s_.subsurface)),
      coat_class_(s_.coat_facets.event_class(specular_alpha)),
      facet_class_(s_.facets.event_class(specular_alpha)),
      has_coat_(s_.coat_weight > 0.0f && s_.coat_ior != 1.0f),
      facets_transmit_(s_.transmitting() > 0.0f && !s_.straight()) {
  const bool dielectric = s_.metalness < 1.0f && !layers->fresnel().no_dielectric();
  has_facets_ = s_.metalness > 0.0f || dielectric || facets_transmit_;
  const bool scatters =
      s_.fuzz_weight > 0.0f || !diffuse_share_.is_black() || !through_share_.is_black();
  if (scatters) finite_classes_ = ClassMask::kDiffuse;
  if (has_coat_ && !s_.coat_facets.smooth())
    finite_classes_ = finite_classes_ | mask_of(coat_class_);
  if (has_facets_ && !s_.facets.smooth()) finite_classes_ = finite_classes_ | mask_of(facet_class_);
  classes_ = finite_classes_;
  if (!subsurface_share_.is_black()) classes_ = classes_ | ClassMask::kDiffuse;
  if (has_coat_) classes_ = classes_ | mask_of(coat_class_);
  if (has_facets_) classes_ = classes_ | mask_of(facet_class_);
}

PrincipledBsdf::View PrincipledBsdf::view(const Vec3f& wo, ClassMask among) const {
  View v;
  v.wo = wo;
  v.side = wo.z > 0.0f ? 1.0f : -1.0f;
  v.up = wo * v.side;
  v.inside = wo.z < 0.0f && s_.refracts();
  v.passed = layers_->passed(wo);
  if (s_.opaque() > 0.0f) v.base = layers_->reaches_base(wo, v.passed);
  v.shares = energies(v, among);
  float sum = 0.0f;
  for (const float share : v.shares) sum += share;
  if (sum > 0.0f)
    for (float& share : v.shares) share /= sum;
  return v;
}

PrincipledBsdf::Shares PrincipledBsdf::energies(const View& v, ClassMask among) const {
  Shares e{};
  const float c = v.up.z;
  if (contains(among, EventClass::kDiffuse)) {
    if (s_.fuzz_weight > 0.0f) e[kFuzz] = std::max(layers_->fuzz_albedo(c), s_.fuzz_weight * 0.05f);
    e[kDiffuse] = (diffuse_share_ * diffuse_.reflectance() * v.base).max_component();
    e[kDiffuseThrough] = (through_share_ * v.base).max_component();
    e[kSubsurface] = (subsurface_share_ * v.base).max_component();
  }
  const bool joined = has_coat_ && has_facets_ && s_.coat_facets.smooth() && s_.facets.smooth();
  if (has_coat_ && !joined && contains(among, coat_class_))
    e[kCoat] = std::max(layers_->coat_albedo(v.up) * v.passed.fuzz, kMinEnergy * s_.coat_weight);
  if (has_facets_ && contains(among, facet_class_)) {
    const float sent = facet_reflectance(v, v.passed, c).average() + joined_coat(v);
    const float crossed = facets_transmit_
                              ? facet_transmittance(v, v.inside ? Passed() : v.passed, c).average()
                              : 0.0f;
    e[kFacets] = std::max(sent + crossed, s_.facets.smooth() ? 0.0f : kMinEnergy);
    if (s_.metalness > 0.0f && !s_.facets.smooth())
      e[kMultiple] = s_.metalness * v.passed.above * layers_->lost(v.up);
  }
  if (s_.straight()) e[kStraight] = straight_transmittance(v.wo).average();
  return e;
}

float PrincipledBsdf::joined_coat(const View& v) const {
  if (!has_coat_ || !has_facets_ || !s_.coat_facets.smooth() || !s_.facets.smooth()) return 0.0f;
  const float outside = v.inside ? 1.0f - s_.transmitting() : 1.0f;
  return outside * v.passed.fuzz * layers_->coat_fresnel(v.up.z);
}

SampledSpectrum PrincipledBsdf::facet_reflectance(const View& v, const Passed& passed,
                                                  float c) const {
  const PrincipledFresnel& fresnel = layers_->fresnel();
  SampledSpectrum sum;
  if (s_.metalness > 0.0f) sum += fresnel.metal(c) * layers_->metal_darkening() * s_.metalness;
  if (s_.metalness < 1.0f && !fresnel.no_dielectric()) {
    const float walls = s_.thin_walled ? s_.transmitting() : 0.0f;
    const float boundary = s_.opaque() + (v.inside || s_.thin_walled ? 0.0f : s_.transmitting());
    SampledSpectrum r;
    if (boundary > 0.0f) r += fresnel.dielectric(c) * boundary;
    if (walls > 0.0f) r += fresnel.wall(c) * walls;
    sum += r * s_.specular_color;
  }
  sum *= std::min(v.passed.above, passed.above);
  sum *= v.passed.color * passed.color;
  if (v.inside) sum += fresnel.dielectric_inside(c) * s_.transmitting();
  return sum;
}

SampledSpectrum PrincipledBsdf::facet_transmittance(const View& v, const Passed& outside,
                                                    float c) const {
  const PrincipledFresnel& fresnel = layers_->fresnel();
  const SampledSpectrum reflected = s_.thin_walled ? fresnel.wall(c)
                                    : v.inside     ? fresnel.dielectric_inside(c)
                                                   : fresnel.dielectric(c);
  return (SampledSpectrum(1.0f) - reflected) * s_.transmission_color * outside.color *
         (s_.transmitting() * outside.above);
}

SampledSpectrum PrincipledBsdf::straight_transmittance(const Vec3f& wo) const {
  if (!s_.straight()) return {};
  View v;
  return facet_transmittance(v, layers_->passed(wo), std::abs(wo.z));
}

float PrincipledBsdf::reflection_share(const View& v, float c) const {
  if (!facets_transmit_) return 1.0f;
  const float r = facet_reflectance(v, v.passed, c).average();
  const float t = facet_transmittance(v, v.inside ? Passed() : v.passed, c).average();
  return r + t > 0.0f ? r / (r + t) : 1.0f;
}

float PrincipledBsdf::eta_between(const Vec3f& wo, const Vec3f& wi) const {
  if (!s_.refracts() || same_side(wo, wi)) return 1.0f;
  return wo.z > 0.0f ? s_.ior : 1.0f / s_.ior;
}

BsdfEval PrincipledBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                              ClassMask among) const {
  if (!contains(among & finite_classes_, c) || wo.z == 0.0f || wi.z == 0.0f) return {};
  return evaluate(view(wo, among), wi, mode, c);
}

BsdfEval PrincipledBsdf::evaluate(const View& v, const Vec3f& wi, TransportMode mode,
                                  EventClass c) const {
  BsdfEval e;
  if (same_side(v.wo, wi))
    add_reflection(v, wi * v.side, c, e);
  else
    add_transmission(v, wi, mode, c, e);
  return e.f.is_finite() && std::isfinite(e.pdf_w) ? e : BsdfEval{};
}

void PrincipledBsdf::add_reflection(const View& v, const Vec3f& up, EventClass c,
                                    BsdfEval& e) const {
  const Passed passed = layers_->passed(up);
  const float outside = v.inside ? 1.0f - s_.transmitting() : 1.0f;
  if (c == EventClass::kDiffuse) {
    if (s_.fuzz_weight > 0.0f) {
      const float f = layers_->fuzz().f(v.up, up, s_.fuzz_roughness);
      e.f += s_.fuzz_color * (outside * s_.fuzz_weight * f);
      e.pdf_w += v.shares[kFuzz] * kInv2Pi;
    }
    if (v.shares[kDiffuse] > 0.0f) {
      const SampledSpectrum coupled = layers_->couple(v.base, layers_->reaches_base(up, passed));
      e.f += diffuse_share_ * coupled * diffuse_.pi_f(v.up, up) * kInvPi;
      e.pdf_w += v.shares[kDiffuse] * lerp(uniform_share(), up.z * kInvPi, kInv2Pi);
    }
  }
  if (c == coat_class_ && has_coat_ && !s_.coat_facets.smooth()) {
    const Vec3f m = normalize(v.up + up);
    const TrowbridgeReitz& facets = s_.coat_facets;
    const float g =
        facets.d(m) * TrowbridgeReitz::g2_over_4zz(facets.s(v.up), v.up.z, facets.s(up), up.z);
    const float r = layers_->coat_fresnel(dot(up, m)) * std::min(v.passed.fuzz, passed.fuzz);
    e.f += SampledSpectrum(outside * r * g);
    e.pdf_w += v.shares[kCoat] * facets.reflection_pdf_w(v.up, m);
  }
  if (c == facet_class_ && has_facets_ && !s_.facets.smooth()) add_facets(v, up, passed, e);
}

void PrincipledBsdf::add_facets(const View& v, const Vec3f& up, const Passed& passed,
                                BsdfEval& e) const {
  const Vec3f m = normalize(v.up + up);
  const TrowbridgeReitz& facets = s_.facets;
  const float c = dot(up, m);
  const float g =
      facets.d(m) * TrowbridgeReitz::g2_over_4zz(facets.s(v.up), v.up.z, facets.s(up), up.z);
  e.f += facet_reflectance(v, passed, c) * g;
  e.pdf_w += v.shares[kFacets] * reflection_share(v, c) * facets.reflection_pdf_w(v.up, m);
  if (v.shares[kMultiple] > 0.0f) {
    const float lost = layers_->lost(v.up) * layers_->lost(up);
    e.f += layers_->multiple() * layers_->metal_darkening() * v.passed.color * passed.color *
           (s_.metalness * std::min(v.passed.above, passed.above) * lost);
    // Facets that are not very rough lose light at grazing angles only.
    e.pdf_w += v.shares[kMultiple] * kInv4Pi / std::sqrt(up.z);
  }
}

void PrincipledBsdf::add_transmission(const View& v, const Vec3f& wi, TransportMode mode,
                                      EventClass c, BsdfEval& e) const {
  if (c == EventClass::kDiffuse && v.shares[kDiffuseThrough] > 0.0f) {
    const SampledSpectrum base = layers_->reaches_base(wi, layers_->passed(wi));
    e.f += through_share_ * layers_->couple(v.base, base) * kInvPi;
    e.pdf_w += v.shares[kDiffuseThrough] * std::abs(wi.z) * kInvPi;
  }
  if (c != facet_class_ || !facets_transmit_ || s_.facets.smooth()) return;
  if (s_.thin_walled)
    add_wall(v, Vec3f(wi.x, wi.y, -wi.z) * v.side, e);
  else
    add_refraction(v, wi, mode, e);
}

void PrincipledBsdf::add_wall(const View& v, const Vec3f& up, BsdfEval& e) const {
  const Vec3f m = normalize(v.up + up);
  const TrowbridgeReitz& facets = s_.facets;
  const float c = dot(up, m);
  const Passed other = layers_->passed(up);
  Passed both;
  both.above = std::min(v.passed.above, other.above);
  both.color = sqrt(v.passed.color * other.color);
  const float g =
      facets.d(m) * TrowbridgeReitz::g2_over_4zz(facets.s(v.up), v.up.z, facets.s(up), up.z);
  e.f += facet_transmittance(v, both, c) * g;
  e.pdf_w += v.shares[kFacets] * (1.0f - reflection_share(v, c)) * facets.reflection_pdf_w(v.up, m);
}

void PrincipledBsdf::add_refraction(const View& v, const Vec3f& wi, TransportMode mode,
                                    BsdfEval& e) const {
  const float eta = eta_between(v.wo, wi);
  Vec3f m = wi * eta + v.wo;
  if (!(length_squared(m) > 0.0f)) return;
  m = normalize(m);
  if (m.z < 0.0f) m = -m;
  const float om = dot(v.wo, m), im = dot(wi, m), c = std::abs(om);
  // Facets seen from behind do not scatter.
  if (om * v.wo.z <= 0.0f || im * wi.z <= 0.0f) return;
  const float denominator = sqr(im + om / eta);
  if (!(denominator > 0.0f)) return;
  const float jacobian = std::abs(im * om) / denominator;
  const TrowbridgeReitz& facets = s_.facets;
  const float zo = v.up.z, zi = std::abs(wi.z), so = facets.s(v.wo), si = facets.s(wi);
  const float d = facets.d(m);
  float g = 4.0f * d * TrowbridgeReitz::g2_over_4zz(so, zo, si, zi) * jacobian;
  if (mode == TransportMode::kRadiance) g /= sqr(eta);
  e.f += facet_transmittance(v, v.inside ? layers_->passed(wi) : v.passed, c) * g;
  e.pdf_w += v.shares[kFacets] * (1.0f - reflection_share(v, c)) * 2.0f * d / (zo + so) * jacobian;
}

SampledSpectrum PrincipledBsdf::albedo(const Vec3f& wo) const {
  if (wo.z == 0.0f) return {};
  const View v = view(wo, ClassMask::kAll);
  SampledSpectrum sum = facet_reflectance(v, v.passed, v.up.z) +
                        SampledSpectrum(layers_->coat_albedo(v.up) * v.passed.fuzz) +
                        s_.fuzz_color * layers_->fuzz_albedo(v.up.z);
  if (s_.transmitting() > 0.0f)
    sum += facet_transmittance(v, v.inside ? Passed() : v.passed, v.up.z);
  return sum + (diffuse_share_ * diffuse_.reflectance() + through_share_ +
                subsurface_share_ * s_.subsurface_color) *
                   v.base;
}

}  // namespace nephroid
