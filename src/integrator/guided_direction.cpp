#include "integrator/guided_direction.h"

#include <algorithm>

namespace nephroid {

namespace {

constexpr float kShareOfForecast = 0.5f;
constexpr EventClass kGuidedClasses[] = {EventClass::kDiffuse, EventClass::kGlossy};

}  // namespace

GuidedDirection::GuidedDirection(const Bsdf& bsdf, const Frame& shading, const Vec3f& wo,
                                 ClassMask among, const ForecastLobes& lobes)
    : bsdf_(bsdf),
      shading_(shading),
      wo_(wo),
      among_(among),
      guided_(bsdf.finite_classes() & among & ClassMask::kRough),
      lobes_(lobes),
      share_(lobes.empty() || guided_ == ClassMask::kNone ? 0.0f : kShareOfForecast) {}

std::optional<BsdfSample> GuidedDirection::sample(float uc, const Vec2f& u, float& gain) const {
  if (uc < share_) return sample_forecast(uc / share_, u, gain);
  std::optional<BsdfSample> s =
      bsdf_.sample(wo_, (uc - share_) / (1.0f - share_), u, TransportMode::kRadiance, among_);
  if (!s) return s;
  const bool finite = !s->delta && !s->straight_through && !s->subsurface;
  const float pdf = finite ? pdf_w(s->wi, s->event, s->pdf_w) : s->pdf_w * (1.0f - share_);
  gain = s->pdf_w > 0.0f ? pdf / s->pdf_w : 1.0f;
  s->pdf_w = pdf;
  return s;
}

float GuidedDirection::pdf_w(const Vec3f& wi, EventClass c, float bsdf_pdf_w) const {
  float pdf = bsdf_pdf_w * (1.0f - share_);
  if (share_ > 0.0f && bsdf_pdf_w > 0.0f && contains(guided_, c))
    pdf += share_ * lobes_.pdf_w(shading_.to_world(wi)) * (bsdf_pdf_w / rough_pdf_w(wi));
  return pdf;
}

float GuidedDirection::rough_pdf_w(const Vec3f& wi) const {
  float sum = 0;
  for (const EventClass c : kGuidedClasses)
    if (contains(guided_, c)) sum += eval(wi, c).pdf_w;
  return sum;
}

// The number that chooses the lobe chooses the class with what is left of it.
std::optional<BsdfSample> GuidedDirection::sample_forecast(float uc, const Vec2f& u,
                                                           float& gain) const {
  const float scaled = uc * static_cast<float>(lobes_.count());
  const int lobe = std::min(static_cast<int>(scaled), lobes_.count() - 1);
  const Vec3f wi = shading_.to_local(lobes_.sample(lobe, u));
  float left = (scaled - static_cast<float>(lobe)) * rough_pdf_w(wi);
  std::optional<BsdfSample> s;
  for (const EventClass c : kGuidedClasses) {
    if (!contains(guided_, c)) continue;
    const BsdfEval e = eval(wi, c);
    if (!(e.pdf_w > 0.0f)) continue;
    if (!s || left >= 0.0f) {
      s.emplace();
      s->f = e.f;
      s->wi = wi;
      s->pdf_w = pdf_w(wi, c, e.pdf_w);
      gain = s->pdf_w / e.pdf_w;
      s->eta = bsdf_.eta_between(wo_, wi);
      s->event = c;
      s->transmitted = wo_.z * wi.z < 0.0f;
    }
    left -= e.pdf_w;
    if (left < 0.0f) break;
  }
  return s;
}

}  // namespace nephroid
