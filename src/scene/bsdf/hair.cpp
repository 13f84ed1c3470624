// Value, density and sampling of hair; see hair.h. Each lobe is a product A_p M_p N_p:
// transmittance inside the fibre, a longitudinal density (d'Eon et al. 2011: von Mises-Fisher on
// the sphere, seen along one axis) and an azimuthal one (Chiang et al. 2016: a logistic cut off at
// +-pi).
#include "scene/bsdf/hair.h"

#include "scene/bsdf/fresnel.h"

namespace nephroid {
namespace {

constexpr float kTurn = 2.0f * kPi;

/// log(I0(x)) - x, I0 the modified Bessel function, x >= 0: its series, or for large x its
/// asymptotic expansion (Abramowitz & Stegun 9.6.12, 9.7.1).
float log_i0_scaled(float x) {
  if (x > 12.0f) {
    const float r = 1.0f / (8.0f * x);
    return std::log((1.0f + r * (1.0f + r * (4.5f + r * 37.5f))) / std::sqrt(kTurn * x));
  }
  const float q = 0.25f * x * x;
  float term = 1.0f, sum = 1.0f;
  for (int i = 1; i < 30 && term > 1e-8f * sum; ++i) {
    term *= q / static_cast<float>(i * i);
    sum += term;
  }
  return std::log(sum) - x;
}

/// M_p: density of sin(theta_i), the same for all azimuths. The exponent (cos(theta_i + theta_o) -
/// 1) / v is written as a sum of squares, which keeps precision for narrow lobes.
float longitudinal(float cos_i, float sin_i, float cos_o, float sin_o, float v) {
  const float exponent = -0.5f * (sqr(cos_i - cos_o) + sqr(sin_i + sin_o)) / v;
  return std::exp(exponent + log_i0_scaled(cos_i * cos_o / v)) / (v * -std::expm1(-2.0f / v));
}

/// Logistic density of scale s, cut off at +-pi.
float trimmed_logistic(float x, float s) {
  const float e = std::exp(-std::abs(x) / s);
  return e / (s * sqr(1.0f + e)) / std::tanh(kPi / (2.0f * s));
}

float sample_trimmed_logistic(float u, float s) {
  const float low = 1.0f / (1.0f + std::exp(kPi / s));  // mass of the full logistic below -pi
  const float x = -s * std::log(1.0f / (low + u * (1.0f - 2.0f * low)) - 1.0f);
  return std::clamp(x, -kPi, kPi);
}

/// The angle wrapped into [-pi, pi].
float wrapped(float angle) {
  return std::clamp(angle - kTurn * std::round(angle / kTurn), -kPi, kPi);
}

}  // namespace

HairShape::HairShape(float beta_m, float beta_n, float scale_tilt_degrees) {
  // Both fits are by Chiang et al. 2016, sections 4.1 and 4.2.
  const float m = 0.726f * beta_m + 0.812f * sqr(beta_m) + 3.7f * std::pow(beta_m, 20.0f);
  v = {m * m, 0.25f * m * m, 4.0f * m * m, 4.0f * m * m};
  const float sqrt_pi_over_8 = std::sqrt(kPi / 8.0f);
  s = sqrt_pi_over_8 * (0.265f * beta_n + 1.194f * sqr(beta_n) + 5.372f * std::pow(beta_n, 22.0f));
  const float alpha = scale_tilt_degrees * kPi / 180.0f;
  const float turned[] = {-2.0f * alpha, alpha, 4.0f * alpha};
  for (size_t p = 0; p < 3; ++p) {
    sin_tilt[p] = std::sin(turned[p]);
    cos_tilt[p] = std::cos(turned[p]);
  }
}

HairBsdf::HairBsdf(float h, float eta, const SampledSpectrum& sigma_a, const HairShape& shape)
    : h_(std::clamp(h, -1.0f, 1.0f)),
      gamma_o_(std::asin(h_)),
      eta_(eta),
      sigma_a_(sigma_a),
      shape_(shape) {}

float HairBsdf::azimuth(int p, float gamma_t) const {
  return 2.0f * static_cast<float>(p) * gamma_t - 2.0f * gamma_o_ + static_cast<float>(p) * kPi;
}

HairBsdf::Outgoing HairBsdf::outgoing(const Vec3f& wo) const {
  Outgoing o;
  o.sin_theta = std::clamp(wo.x, -1.0f, 1.0f);
  o.cos_theta = std::sqrt(wo.y * wo.y + wo.z * wo.z);
  o.phi = std::atan2(wo.z, wo.y);

  // The path inside: refraction along the fibre, and across it with the index of the inclined cross
  // section (Marschner et al. 2003).
  const float cos_theta_t = safe_sqrt(1.0f - sqr(o.sin_theta / eta_));
  const float eta_across = safe_sqrt(sqr(eta_) - sqr(o.sin_theta));  // times cos theta_o
  const float sin_gamma_t =
      eta_across > 0.0f ? std::clamp(h_ * o.cos_theta / eta_across, -1.0f, 1.0f) : 0.0f;
  const float cos_gamma_t = safe_sqrt(1.0f - sqr(sin_gamma_t));
  o.gamma_t = std::asin(sin_gamma_t);
  const SampledSpectrum through =
      exp(sigma_a_ * (-2.0f * cos_gamma_t / std::max(cos_theta_t, 1e-4f)));

  const float f = fresnel_dielectric(o.cos_theta * safe_sqrt(1.0f - sqr(h_)), eta_);
  o.attenuation[0] = SampledSpectrum(f);
  o.attenuation[1] = through * sqr(1.0f - f);
  o.attenuation[2] = o.attenuation[1] * through * f;
  o.attenuation[3] = safe_div(o.attenuation[2] * through * f, SampledSpectrum(1.0f) - through * f);
  float sum = 0.0f;
  for (const SampledSpectrum& a : o.attenuation) sum += a.average();
  if (sum > 0.0f)
    for (size_t p = 0; p < kLobes; ++p) o.pdf_p[p] = o.attenuation[p].average() / sum;

  for (size_t p = 0; p < 3; ++p) {
    o.sin_tilted[p] = o.sin_theta * shape_.cos_tilt[p] + o.cos_theta * shape_.sin_tilt[p];
    o.cos_tilted[p] = std::abs(o.cos_theta * shape_.cos_tilt[p] - o.sin_theta * shape_.sin_tilt[p]);
  }
  o.sin_tilted[3] = o.sin_theta;
  o.cos_tilted[3] = o.cos_theta;
  return o;
}

BsdfEval HairBsdf::eval(const Outgoing& o, const Vec3f& wi) const {
  const float cos_i = std::sqrt(wi.y * wi.y + wi.z * wi.z);
  const float phi = std::atan2(wi.z, wi.y) - o.phi;
  BsdfEval e;
  for (size_t p = 0; p < kLobes; ++p) {
    const int turns = static_cast<int>(p);
    const float around = p + 1 < kLobes
                             ? trimmed_logistic(wrapped(phi - azimuth(turns, o.gamma_t)), shape_.s)
                             : kInv2Pi;
    const float value =
        longitudinal(cos_i, wi.x, o.cos_tilted[p], o.sin_tilted[p], shape_.v[p]) * around;
    e.f += o.attenuation[p] * value;
    e.pdf_w += o.pdf_p[p] * value;
  }
  // The cosine that transport multiplies by is not part of the fibre model.
  e.f /= std::max(abs_cos_theta(wi), 1e-30f);
  return e;
}

BsdfEval HairBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode, EventClass c,
                        ClassMask among) const {
  if (c != EventClass::kDiffuse || !contains(among, c)) return {};
  return eval(outgoing(wo), wi);
}

std::optional<BsdfSample> HairBsdf::sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode,
                                           ClassMask among) const {
  if (!contains(among, EventClass::kDiffuse)) return std::nullopt;
  const Outgoing o = outgoing(wo);
  size_t p = 0;
  while (p + 1 < kLobes && uc >= o.pdf_p[p]) uc -= o.pdf_p[p++];
  if (!(o.pdf_p[p] > 0.0f)) return std::nullopt;
  uc = std::clamp(uc / o.pdf_p[p], 0.0f, kOneMinusEpsilon);

  // M_p: a direction around the mirrored one, of which only the longitude is kept.
  const float v = shape_.v[p];
  const float cos_cone = std::clamp(
      1.0f + v * std::log(std::max(1e-37f, u.x + (1.0f - u.x) * std::exp(-2.0f / v))), -1.0f, 1.0f);
  const float sin_i =
      std::clamp(-cos_cone * o.sin_tilted[p] +
                     safe_sqrt(1.0f - sqr(cos_cone)) * std::cos(kTurn * u.y) * o.cos_tilted[p],
                 -1.0f, 1.0f);
  const float cos_i = safe_sqrt(1.0f - sqr(sin_i));
  const float turn = p + 1 < kLobes ? azimuth(static_cast<int>(p), o.gamma_t) +
                                          sample_trimmed_logistic(uc, shape_.s)
                                    : kTurn * uc;
  const float phi = o.phi + turn;

  BsdfSample s;
  s.wi = Vec3f(sin_i, cos_i * std::cos(phi), cos_i * std::sin(phi));
  if (s.wi.z == 0.0f) return std::nullopt;
  const BsdfEval e = eval(o, s.wi);
  if (!(e.pdf_w > 0.0f)) return std::nullopt;
  s.f = e.f;
  s.pdf_w = e.pdf_w;
  s.transmitted = (s.wi.z > 0.0f) != (wo.z > 0.0f);
  return s;
}

SampledSpectrum HairBsdf::albedo(const Vec3f& wo) const {
  SampledSpectrum sum;
  for (const SampledSpectrum& a : outgoing(wo).attenuation) sum += a;
  return sum;
}

}  // namespace nephroid
