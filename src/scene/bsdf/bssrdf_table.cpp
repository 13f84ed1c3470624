// Photon beam diffusion and the table of its profiles; see bssrdf_table.h.
#include "scene/bsdf/bssrdf_table.h"

#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/fresnel_moments.h"

namespace nephroid {
namespace {

constexpr int kDepths = 100;
/// Share of a profile that lies within its reach.
constexpr float kReached = 0.999f;

/// Depth of the i-th of kDepths samples of exponential transmittance with extinction 1.
double sampled_depth(int i) {
  return -std::log(1.0 - (i + 0.5) / kDepths);
}

/// Henyey-Greenstein, 1/sr; `cosine` is between the directions towards where light came from and
/// where it goes.
double phase(double cosine, double g) {
  const double d = 1.0 + g * g + 2.0 * g * cosine;
  return (1.0 - g * g) / (4.0 * kPiDouble * d * std::sqrt(d));
}

}  // namespace

double beam_diffusion_single(double albedo, double g, double eta, double r) {
  // Light scattered above this depth is totally reflected at the boundary (eta > 1).
  const double critical = r * std::sqrt(std::max(0.0, eta * eta - 1.0));
  double sum = 0.0;
  for (int i = 0; i < kDepths; ++i) {
    const double depth = critical + sampled_depth(i);
    const double d = std::sqrt(r * r + depth * depth);
    const double cosine = depth / d;
    const double through =
        1.0 - fresnel_dielectric(static_cast<float>(-cosine), static_cast<float>(eta));
    sum += std::exp(-(d + critical)) / (d * d) * phase(cosine, g) * through * cosine;
  }
  return albedo * sum / kDepths;
}

double beam_diffusion_multiple(double albedo, double g, double eta, double r) {
  // Similarity theory: scattering of mean cosine g acts as isotropic scattering 1-g times as
  // strong.
  const double absorption = 1.0 - albedo, scattering = albedo * (1.0 - g);
  const double extinction = absorption + scattering;
  if (!(scattering > 0.0)) return 0.0;
  const double reduced_albedo = scattering / extinction;
  // Grosjean's diffusion coefficient.
  const double diffusion = (2.0 * absorption + scattering) / (3.0 * extinction * extinction);
  const double transport = std::sqrt(absorption / diffusion);
  // The dipole's mirror plane, and the weights of fluence and of its gradient in the exitance.
  const double m1 = fresnel_moment_1(eta), m2 = fresnel_moment_2(eta);
  const double mirror = -2.0 * diffusion * (1.0 + 3.0 * m2) / (1.0 - 2.0 * m1);
  const double of_fluence = 0.25 * (1.0 - 2.0 * m1), of_gradient = 0.5 * (1.0 - 3.0 * m2);

  double sum = 0.0;
  for (int i = 0; i < kDepths; ++i) {
    const double z_real = sampled_depth(i) / extinction;
    const double z_virtual = 2.0 * mirror - z_real;
    const double d_real = std::sqrt(r * r + z_real * z_real);
    const double d_virtual = std::sqrt(r * r + z_virtual * z_virtual);
    const double e_real = std::exp(-transport * d_real);
    const double e_virtual = std::exp(-transport * d_virtual);
    const double fluence =
        (e_real / d_real - e_virtual / d_virtual) / (4.0 * kPiDouble * diffusion);
    const double gradient =
        (z_real * (1.0 + transport * d_real) * e_real / (d_real * d_real * d_real) -
         z_virtual * (1.0 + transport * d_virtual) * e_virtual /
             (d_virtual * d_virtual * d_virtual)) /
        (4.0 * kPiDouble);
    // Beam diffusion is too bright near the beam; this empirical factor corrects it.
    const double near = 1.0 - std::exp(-2.0 * extinction * (d_real + z_real));
    sum += near * (fluence * of_fluence + gradient * of_gradient);
  }
  return reduced_albedo * reduced_albedo * sum / kDepths;
}

BssrdfTable::BssrdfTable(float g, float eta)
    : g_(g),
      eta_(eta),
      albedos_(kAlbedos),
      radii_(kRadii),
      profile_(static_cast<size_t>(kAlbedos) * kRadii),
      cumulative_(profile_.size()),
      effective_(kAlbedos),
      reach_(kAlbedos) {
  // Radii are denser where the profile is steep, albedos where they are high.
  radii_[0] = 0.0f;
  radii_[1] = 2.5e-3f;
  for (size_t i = 2; i < radii_.size(); ++i) radii_[i] = radii_[i - 1] * 1.2f;
  for (int i = 0; i < kAlbedos; ++i)
    albedos_[i] = static_cast<float>(std::expm1(-8.0 * i / (kAlbedos - 1)) / std::expm1(-8.0));
  for (int i = 0; i < kAlbedos; ++i) fill_row(i);
  for (int i = 1; i < kAlbedos; ++i)
    reach_[i] = sample_radius(albedo_weights(albedos_[i]), kReached).value_or(0.0f);
  reach_[0] = reach_[1];  // no light leaves, so this is a limit
}

void BssrdfTable::fill_row(int albedo) {
  const double a = albedos_[albedo];
  for (int j = 0; j < kRadii; ++j) {
    const double r = radii_[j];
    profile_[index(albedo, j)] = static_cast<float>(
        2.0 * kPiDouble * r *
        (beam_diffusion_single(a, g_, eta_, r) + beam_diffusion_multiple(a, g_, eta_, r)));
  }
  effective_[albedo] =
      spline_integrate(radii_, std::span(profile_).subspan(index(albedo, 0), kRadii),
                       std::span(cumulative_).subspan(index(albedo, 0), kRadii));
}

SplineWeights BssrdfTable::albedo_weights(float albedo) const {
  return *spline_value(albedos_, albedo >= 0.0f ? std::min(albedo, albedos_.back()) : 0.0f);
}

float BssrdfTable::radial_density(const SplineWeights& albedo, float r) const {
  const std::optional<SplineWeights> radius = spline_value(radii_, r);
  if (!radius) return 0.0f;
  return albedo.of([&](int a) { return radius->of([&](int k) { return profile(a, k); }); });
}

std::optional<float> BssrdfTable::sample_radius(const SplineWeights& albedo, float u) const {
  const auto cumulative = [&](int radius) {
    return albedo.of([&](int a) { return cumulative_[index(a, radius)]; });
  };
  const float target = u * cumulative(kRadii - 1);
  if (!(cumulative(kRadii - 1) > 0.0f)) return std::nullopt;
  // The last interval that starts at or below the target.
  int low = 0, high = kRadii - 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (cumulative(middle) <= target ? low : high) = middle;
  }
  const float rest = target - cumulative(low);
  const SplineSegment segment(radii_, low, [&](int radius) {
    return albedo.of([&](int a) { return profile(a, radius); });
  });
  const float of_all = segment.integral(1.0f);
  const float t = solve_rising(of_all > rest ? rest / of_all : 1.0f, [&](float s) {
    return std::pair{segment.integral(s) - rest, segment.width() * segment.value(s)};
  });
  return radii_[low] + t * segment.width();
}

std::shared_ptr<const BssrdfTable> BssrdfTableCache::find_or_make(float g, float eta) {
  auto& table = tables_[{g, eta}];
  if (!table) table = std::make_shared<BssrdfTable>(g, eta);
  return table;
}

}  // namespace nephroid
