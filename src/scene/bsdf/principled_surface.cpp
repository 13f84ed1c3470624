// Fresnel terms of the principled surface; see principled_surface.h.
#include "scene/bsdf/principled_surface.h"

#include "scene/bsdf/fresnel.h"

namespace nephroid {
namespace {

/// The index whose reflectance at normal incidence is `weight` times that of `eta`.
float weighted_index(float eta, float weight) {
  if (weight == 1.0f) return eta;
  const float root = std::sqrt(std::min(weight * sqr((eta - 1.0f) / (eta + 1.0f)), 0.9999f));
  const float e = eta < 1.0f ? -root : root;
  return (1.0f + e) / (1.0f - e);
}

/// The index above the base, below a coat that covers a share of the surface.
float index_above_base(const PrincipledSurface& s) {
  return s.coat_affects_specular ? lerp(s.coat_weight, 1.0f, s.coat_ior) : 1.0f;
}

/// The index of the base's Fresnel term.
float relative_index(const PrincipledSurface& s) {
  const float eta = s.ior / index_above_base(s);
  // There is no total reflection: the coat has already bent the light towards the normal.
  return eta < 1.0f && s.ior >= 1.0f ? 1.0f / eta : eta;
}

float schlick(float c) {
  const float m = std::clamp(1.0f - c, 0.0f, 1.0f);
  return sqr(sqr(m)) * m;
}

}  // namespace

PrincipledFresnel::PrincipledFresnel(const PrincipledSurface& s)
    : ior_(s.ior),
      eta_(weighted_index(relative_index(s), s.specular_weight)),
      metal_0_(s.metal_color),
      metal_weight_(std::min(s.specular_weight, 1.0f)),
      film_weight_(s.film_weight),
      film_(s.film),
      lambdas_(s.lambdas) {
  // The tint is the reflectance at about 82 degrees, over that of Schlick's term.
  constexpr float kCosine = 1.0f / 7.0f;
  const SampledSpectrum at_82 = metal_0_ + (SampledSpectrum(1.0f) - metal_0_) * schlick(kCosine);
  const float power = sqr(sqr(1.0f - kCosine)) * sqr(1.0f - kCosine);
  metal_slope_ = at_82 * (SampledSpectrum(1.0f) - s.specular_color) / (kCosine * power);
  film_.index /= index_above_base(s);
}

template <class BaseIndex>
SampledSpectrum PrincipledFresnel::with_film(const SampledSpectrum& bare, float c,
                                             const BaseIndex& base) const {
  SampledSpectrum r;
  for (int i = 0; i < kSpectrumSamples; ++i)
    r.set(i, thin_film_reflectance(c, film_, base(i), lambdas_[i]));
  return lerp(film_weight_, bare, r);
}

SampledSpectrum PrincipledFresnel::dielectric(float c) const {
  c = std::min(std::abs(c), 1.0f);
  if (ior_ < 1.0f && 1.0f - c * c >= sqr(ior_)) return SampledSpectrum(1.0f);
  const SampledSpectrum bare(fresnel_dielectric(c, eta_));
  if (film_weight_ == 0.0f) return bare;
  return with_film(bare, c, [this](int) { return std::complex<float>(eta_); });
}

SampledSpectrum PrincipledFresnel::dielectric_inside(float c) const {
  c = std::min(std::abs(c), 1.0f);
  if (eta_ == ior_ && film_weight_ == 0.0f) return SampledSpectrum(fresnel_dielectric(-c, eta_));
  const float sin2 = sqr(ior_) * (1.0f - c * c);
  return sin2 >= 1.0f ? SampledSpectrum(1.0f) : dielectric(std::sqrt(1.0f - sin2));
}

SampledSpectrum PrincipledFresnel::metal(float c) const {
  c = std::min(std::abs(c), 1.0f);
  const float s = schlick(c);
  const SampledSpectrum plain = metal_0_ + (SampledSpectrum(1.0f) - metal_0_) * s;
  const SampledSpectrum tinted =
      clamp(plain - metal_slope_ * (c * s * (1.0f - c)), 0.0f, 1.0f) * metal_weight_;
  if (film_weight_ == 0.0f) return tinted;
  const SampledSpectrum r0 = clamp(metal_0_, 0.0f, 0.9999f);
  const SampledSpectrum k = sqrt(r0) / sqrt(SampledSpectrum(1.0f) - r0) * 2.0f;
  const SampledSpectrum tint = safe_div(tinted, plain);
  const SampledSpectrum filmed =
      with_film(SampledSpectrum(), c, [&](int i) { return std::complex<float>(1.0f, k[i]); });
  return tinted * (1.0f - film_weight_) + filmed * tint;
}

}  // namespace nephroid
