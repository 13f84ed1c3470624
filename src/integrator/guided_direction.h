// A direction at a surface, chosen either by the BSDF or by a guide: the mixture, per class of the
// event, and its density ([T3] in docs/estimators.md).
// Who calls it: forecast.cpp, eye_path.cpp. It must not know routes or lights.
#pragma once

#include <optional>

#include "core/math.h"
#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// Classes whose directions a guide may choose: those of finite lobes of class D and G.
inline ClassMask guided_classes(const Bsdf& bsdf, ClassMask among) {
  return bsdf.finite_classes() & among & ClassMask::kRough;
}
/// p_R of [T3]: density with which the BSDF finds the local direction `wi` by one of these.
float guided_pdf_w(const Bsdf& bsdf, const Vec3f& wo, const Vec3f& wi, ClassMask among);

/// The mixture at one vertex. Only finite lobes of class D and G are guided; with an empty guide it
/// is the BSDF alone. A `Guide`, ForecastLobes or DirectionTree, has
///   bool empty() const
///   float share() const                          of the directions that follow it, below 1
///   Vec3f sample(float& uc, const Vec2f&) const  a unit direction, world; what it uses of `uc` is
///                                                taken out of it
///   float pdf_w(const Vec3f&) const
template <class Guide>
class GuidedDirection {
 public:
  /// `shading` is the frame of the BSDF, `among` the classes that the walk may sample.
  GuidedDirection(const Bsdf& bsdf, const Frame& shading, const Vec3f& wo, ClassMask among,
                  const Guide& guide);

  /// As Bsdf::sample, with the density of the mixture. `gain` becomes that density over the
  /// BSDF's alone.
  std::optional<BsdfSample> sample(float uc, const Vec2f& u, float& gain) const;
  /// Density with which sample() finds the local direction `wi` in class `c`, whose density by the
  /// BSDF alone is `bsdf_pdf_w`; delta lobes left out.
  float pdf_w(const Vec3f& wi, EventClass c, float bsdf_pdf_w) const;

 private:
  BsdfEval eval(const Vec3f& wi, EventClass c) const {
    return bsdf_.eval(wo_, wi, TransportMode::kRadiance, c, among_);
  }
  std::optional<BsdfSample> sample_guide(float uc, const Vec2f& u, float& gain) const;

  const Bsdf& bsdf_;
  const Frame& shading_;
  const Vec3f wo_;
  const ClassMask among_, guided_;
  const Guide& guide_;
  const float share_;  ///< of the guide
};

}  // namespace nephroid
