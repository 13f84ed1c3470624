// Samples a direction at a surface from a mixture of BSDF and guide, per event class ([T3] in
// docs/estimators.md). It must not know routes or lights.
#pragma once

#include <optional>

#include "core/math.h"
#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// Classes whose directions a guide may sample: D and G with finite lobes.
inline ClassMask guided_classes(const Bsdf& bsdf, ClassMask among) {
  return bsdf.finite_classes() & among & ClassMask::kRough;
}
/// p_R of [T3]: the BSDF's density of the local direction `wi` in these classes.
inline float guided_pdf_w(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi, TransportMode mode,
                          ClassMask among) {
  const ClassMask guided = guided_classes(bsdf, among);
  float sum = 0;
  for (const EventClass c : kSurfaceClasses)
    if (contains(guided, c)) sum += bsdf.eval(wo, wi, mode, c, among).pdf_w;
  return sum;
}

/// The mixture at one vertex. Only finite lobes of class D and G are guided; with an empty guide it
/// is the BSDF alone. A `Guide`, ForecastLobes, DirectionTree or CasterCones, has
///   bool empty() const
///   float share() const                          share of directions from the guide, below 1
///   Vec3f sample(float& uc, const Vec2f&) const  a unit direction, world; `uc` is rescaled to
///                                                [0,1)
///   float pdf_w(const Vec3f&) const
template <class Guide>
class GuidedDirection {
 public:
  /// `shading` is the frame of the BSDF, `among` the classes that the walk may sample.
  GuidedDirection(const Bsdf& bsdf, const Frame& shading, const Vec3f& wo, TransportMode mode,
                  ClassMask among, const Guide& guide)
      : bsdf_(bsdf),
        shading_(shading),
        wo_(wo),
        mode_(mode),
        among_(among),
        guided_(guided_classes(bsdf, among)),
        guide_(guide),
        share_(guide.empty() || guided_ == ClassMask::kNone ? 0.0f : guide.share()) {}

  /// As Bsdf::sample, with the density of the mixture. `gain` becomes that density over the BSDF's.
  std::optional<BsdfSample> sample(float uc, const Vec2f& u, float& gain) const {
    if (uc < share_) return sample_guide(uc / share_, u, gain);
    std::optional<BsdfSample> s =
        bsdf_.sample(wo_, (uc - share_) / (1.0f - share_), u, mode_, among_);
    if (!s) return s;
    const bool finite = !s->delta && !s->straight_through && !s->subsurface;
    const float pdf = finite ? pdf_w(s->wi, s->event, s->pdf_w) : s->pdf_w * (1.0f - share_);
    gain = s->pdf_w > 0.0f ? pdf / s->pdf_w : 1.0f;
    s->pdf_w = pdf;
    return s;
  }

  /// Density of sample() for the local direction `wi` in class `c`, without delta lobes.
  /// `bsdf_pdf_w` is the BSDF's own density.
  float pdf_w(const Vec3f& wi, EventClass c, float bsdf_pdf_w) const {
    return mixed_pdf_w(wi, shading_.to_world(wi), c, bsdf_pdf_w);
  }

 private:
  float mixed_pdf_w(const Vec3f& wi, const Vec3f& world, EventClass c, float bsdf_pdf_w) const {
    float pdf = bsdf_pdf_w * (1.0f - share_);
    if (!(share_ > 0.0f) || !(bsdf_pdf_w > 0.0f) || !contains(guided_, c)) return pdf;
    const float guide_pdf_w = guide_.pdf_w(world);
    if (!(guide_pdf_w > 0.0f)) return pdf;
    const float all = guided_pdf_w(bsdf_, wo_, wi, mode_, among_);
    // Rounding may let a BSDF sample a direction whose density it then evaluates to 0.
    if (all > 0.0f) pdf += share_ * guide_pdf_w * (bsdf_pdf_w / all);
    return pdf;
  }

  /// Samples the guide; the rest of `uc` chooses the class.
  std::optional<BsdfSample> sample_guide(float uc, const Vec2f& u, float& gain) const {
    const Vec3f world = guide_.sample(uc, u), wi = shading_.to_local(world);
    float left = uc * guided_pdf_w(bsdf_, wo_, wi, mode_, among_);
    std::optional<BsdfSample> s;
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(guided_, c)) continue;
      const BsdfEval e = bsdf_.eval(wo_, wi, mode_, c, among_);
      if (!(e.pdf_w > 0.0f)) continue;
      if (!s || left >= 0.0f) {
        s.emplace();
        s->f = e.f;
        s->wi = wi;
        // The guide's density is that of its own direction: one turned by rounding might lie
        // outside.
        s->pdf_w = mixed_pdf_w(wi, world, c, e.pdf_w);
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

  const Bsdf& bsdf_;
  const Frame& shading_;
  const Vec3f wo_;
  const TransportMode mode_;
  const ClassMask among_, guided_;
  const Guide& guide_;
  const float share_;  ///< share of directions from the guide
};

}  // namespace nephroid
