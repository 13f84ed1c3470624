// Tables and lobes of the coated Lambertian surface; see coated_diffuse.h.
#include "scene/bsdf/coated_diffuse.h"

#include "core/warps.h"

namespace nephroid {
namespace {

float gap(float thickness, float c) {
  return c > 0.0f ? std::exp(-thickness / c) : 0.0f;
}

/// Mean flux that `part` of a rough boundary sends on, over the facets seen from `w`; times the
/// transmittance of the gap along the new direction if `through_gap`. Midpoints of a grid, turned
/// by `turn` about the normal. The second variable runs as 1-(1-y)^2, which flattens the singular
/// tail of the facets.
float facet_mean(const DielectricInterface& boundary, const Vec3f& w, BoundaryPart part,
                 float thickness, bool through_gap, int steps, float turn) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const float x = (static_cast<float>(i) + 0.5f) / static_cast<float>(steps) + turn;
      const float y = 1.0f - (static_cast<float>(j) + 0.5f) / static_cast<float>(steps);
      const Vec2f u(x - std::floor(x), 1.0f - y * y);
      const auto s = boundary.sample(w, 0.5f, u, TransportMode::kImportance, part);
      if (s) sum += 2.0f * y * s->weight * (through_gap ? gap(thickness, std::abs(s->wi.z)) : 1.0f);
    }
  }
  return static_cast<float>(sum / (steps * steps));
}

Vec3f direction(float c) {
  return {safe_sqrt(1.0f - c * c), 0.0f, c};
}

}  // namespace

CoatTable::CoatTable(const DielectricInterface& boundary, float thickness, int max_depth)
    : boundary_(boundary), thickness_(thickness), base_bounces_(max_depth / 2 + max_depth % 2) {
  if (!boundary_.smooth()) fill_rough_tables();
  // Both are integrals over the cosine with weight 2c. The smooth coat is cheap, so it gets more
  // points for the kink at the critical angle.
  const int steps = boundary_.smooth() ? 2048 : 128;
  double inner = 0.0, diffuse = 0.0;
  for (int i = 0; i < steps; ++i) {
    const float c = (static_cast<float>(i) + 0.5f) / static_cast<float>(steps);
    const float weight = 2.0f * c / static_cast<float>(steps);
    const Vec3f from_below = direction(-c);
    const float returned =
        boundary_.smooth() ? boundary_.fresnel(from_below) * gap(thickness_, c)
                           : facet_mean(boundary_, from_below, BoundaryPart::kReflection,
                                        thickness_, true, 24, 0.6180340f * static_cast<float>(i));
    inner += weight * gap(thickness_, c) * returned;
    diffuse += weight * transmission(c);
  }
  inner_reflectance_ = static_cast<float>(inner);
  diffuse_transmission_ = static_cast<float>(diffuse);
}

void CoatTable::fill_rough_tables() {
  for (int i = 0; i <= kNodes; ++i) {
    // The node at grazing angle stands for the limit.
    const float root = std::max(static_cast<float>(i), 1e-2f) / kNodes;
    const Vec3f w = direction(root * root);
    transmission_[i] =
        facet_mean(boundary_, w, BoundaryPart::kTransmission, thickness_, true, 24, 0.0f);
    reflection_[i] =
        facet_mean(boundary_, w, BoundaryPart::kReflection, thickness_, false, 12, 0.0f);
  }
}

float CoatTable::look_up(const Table& table, float c) {
  const float x = std::sqrt(std::min(c, 1.0f)) * kNodes;
  const int i = std::min(static_cast<int>(x), kNodes - 1);
  return lerp(x - static_cast<float>(i), table[i], table[i + 1]);
}

float CoatTable::smooth_transmission(float c) const {
  const float sin2_t = (1.0f - c * c) / sqr(boundary_.eta);
  if (sin2_t >= 1.0f) return 0.0f;
  return (1.0f - fresnel_dielectric(c, boundary_.eta)) * gap(thickness_, std::sqrt(1.0f - sin2_t));
}

float CoatTable::transmission(float c) const {
  return boundary_.smooth() ? smooth_transmission(c) : look_up(transmission_, c);
}

float CoatTable::reflection(float c) const {
  return boundary_.smooth() ? fresnel_dielectric(c, boundary_.eta) : look_up(reflection_, c);
}

SampledSpectrum CoatTable::bounces(const SampledSpectrum& rho) const {
  const SampledSpectrum ratio = rho * inner_reflectance_;
  SampledSpectrum sum, term(1.0f);
  for (int k = 0; k < base_bounces_; ++k) {
    sum += term;
    term *= ratio;
    if (term.max_component() < 1e-8f) break;
  }
  return sum;
}

CoatedDiffuseBsdf::CoatedDiffuseBsdf(const CoatTable* table, const SampledSpectrum& reflectance,
                                     float specular_alpha)
    : table_(table),
      base_(reflectance * table->bounces(reflectance) * (kInvPi / sqr(table->boundary().eta))),
      base_energy_(kPi * base_.max_component() * table->diffuse_transmission()),
      coat_class_(table->boundary().event_class(specular_alpha)),
      has_coat_lobe_(table->boundary().eta != 1.0f),
      coat_is_delta_(table->boundary().smooth()) {}

CoatedDiffuseBsdf::Shares CoatedDiffuseBsdf::shares(float cos_o, float tau_o,
                                                    ClassMask among) const {
  // In proportion to each lobe's energy, so that the weight of a sample hardly varies.
  Shares p;
  if (has_coat_lobe_ && contains(among, coat_class_)) p.coat = table_->reflection(cos_o);
  if (contains(among, EventClass::kDiffuse)) p.base = base_energy_ * tau_o;
  const float sum = p.coat + p.base;
  if (!(sum > 0.0f)) return {};
  p.coat /= sum;
  p.base = 1.0f - p.coat;
  return p;
}

BsdfEval CoatedDiffuseBsdf::eval_above(const Vec3f& wo, const Vec3f& wi, TransportMode mode,
                                       EventClass c, const Shares& p, float tau_o) const {
  BsdfEval e;
  if (c == EventClass::kDiffuse) {
    e.f = base_ * (tau_o * table_->transmission(wi.z));
    e.pdf_w = p.base * wi.z * kInvPi;
  }
  if (c == coat_class_ && !coat_is_delta_) {
    const auto v = table_->boundary().evaluate(wo, wi, mode, BoundaryPart::kReflection);
    e.f += SampledSpectrum(v.f);
    e.pdf_w += p.coat * v.pdf_w;
  }
  return e;
}

BsdfEval CoatedDiffuseBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                                 ClassMask among) const {
  if (!contains(among & finite_classes(), c) || wo.z == 0.0f || wi.z == 0.0f ||
      (wo.z > 0.0f) != (wi.z > 0.0f))
    return {};
  const float tau_o = table_->transmission(std::abs(wo.z));
  const Shares p = shares(std::abs(wo.z), tau_o, among);
  return wo.z > 0.0f ? eval_above(wo, wi, mode, c, p, tau_o)
                     : eval_above(-wo, -wi, mode, c, p, tau_o);
}

std::optional<BsdfSample> CoatedDiffuseBsdf::sample(const Vec3f& wo_any, float uc, const Vec2f& u,
                                                    TransportMode mode, ClassMask among) const {
  if (wo_any.z == 0.0f) return std::nullopt;
  const bool from_below = wo_any.z < 0.0f;
  const Vec3f wo = from_below ? -wo_any : wo_any;
  const float tau_o = table_->transmission(wo.z);
  const Shares p = shares(wo.z, tau_o, among);
  if (!(p.coat + p.base > 0.0f)) return std::nullopt;

  BsdfSample s;
  if (uc < p.coat) {
    const auto mirrored = table_->boundary().sample(wo, 0.0f, u, mode, BoundaryPart::kReflection);
    if (!mirrored) return std::nullopt;
    s.wi = mirrored->wi;
    s.event = coat_class_;
    if (coat_is_delta_) {
      s.f = SampledSpectrum(mirrored->weight / s.wi.z);
      s.pdf_w = p.coat;
      s.delta = true;
    }
  } else {
    s.wi = square_to_cosine_hemisphere(u);
    if (!(s.wi.z > 0.0f)) return std::nullopt;
  }
  if (!s.delta) {
    const BsdfEval e = eval_above(wo, s.wi, mode, s.event, p, tau_o);
    s.f = e.f;
    s.pdf_w = e.pdf_w;
  }
  if (!(s.pdf_w > 0.0f)) return std::nullopt;
  if (from_below) s.wi = -s.wi;
  return s;
}

SampledSpectrum CoatedDiffuseBsdf::albedo(const Vec3f& wo) const {
  const float c = std::abs(wo.z);
  return SampledSpectrum(table_->reflection(c)) +
         base_ * (kPi * table_->transmission(c) * table_->diffuse_transmission());
}

}  // namespace nephroid
