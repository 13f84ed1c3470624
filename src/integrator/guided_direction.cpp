#include "integrator/guided_direction.h"

#include "integrator/direction_tree.h"
#include "photon/forecast_map.h"

namespace nephroid {

namespace {

constexpr EventClass kGuidedClasses[] = {EventClass::kDiffuse, EventClass::kGlossy};

}  // namespace

float guided_pdf_w(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi, ClassMask among) {
  const ClassMask guided = guided_classes(bsdf, among);
  float sum = 0;
  for (const EventClass c : kGuidedClasses)
    if (contains(guided, c)) sum += bsdf.eval(wo, wi, TransportMode::kRadiance, c, among).pdf_w;
  return sum;
}

template <class Guide>
GuidedDirection<Guide>::GuidedDirection(const Bsdf& bsdf, const Frame& shading, const Vec3f& wo,
                                        ClassMask among, const Guide& guide)
    : bsdf_(bsdf),
      shading_(shading),
      wo_(wo),
      among_(among),
      guided_(guided_classes(bsdf, among)),
      guide_(guide),
      share_(guide.empty() || guided_ == ClassMask::kNone ? 0.0f : guide.share()) {}

template <class Guide>
std::optional<BsdfSample> GuidedDirection<Guide>::sample(float uc, const Vec2f& u,
                                                         float& gain) const {
  if (uc < share_) return sample_guide(uc / share_, u, gain);
  std::optional<BsdfSample> s =
      bsdf_.sample(wo_, (uc - share_) / (1.0f - share_), u, TransportMode::kRadiance, among_);
  if (!s) return s;
  const bool finite = !s->delta && !s->straight_through && !s->subsurface;
  const float pdf = finite ? pdf_w(s->wi, s->event, s->pdf_w) : s->pdf_w * (1.0f - share_);
  gain = s->pdf_w > 0.0f ? pdf / s->pdf_w : 1.0f;
  s->pdf_w = pdf;
  return s;
}

template <class Guide>
float GuidedDirection<Guide>::pdf_w(const Vec3f& wi, EventClass c, float bsdf_pdf_w) const {
  float pdf = bsdf_pdf_w * (1.0f - share_);
  if (share_ > 0.0f && bsdf_pdf_w > 0.0f && contains(guided_, c))
    pdf += share_ * guide_.pdf_w(shading_.to_world(wi)) *
           (bsdf_pdf_w / guided_pdf_w(bsdf_, wo_, wi, among_));
  return pdf;
}

// The number that chose the guide chooses the class with what is left of it.
template <class Guide>
std::optional<BsdfSample> GuidedDirection<Guide>::sample_guide(float uc, const Vec2f& u,
                                                               float& gain) const {
  const Vec3f wi = shading_.to_local(guide_.sample(uc, u));
  float left = uc * guided_pdf_w(bsdf_, wo_, wi, among_);
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

template class GuidedDirection<ForecastLobes>;
template class GuidedDirection<DirectionTree>;

}  // namespace nephroid
