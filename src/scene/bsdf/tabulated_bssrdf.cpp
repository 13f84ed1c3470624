// Profiles, probes and their densities; see tabulated_bssrdf.h.
#include "scene/bsdf/tabulated_bssrdf.h"

#include "scene/bsdf/normalized_fresnel.h"

namespace nephroid {
namespace {

/// Mean free paths up to which the profile is taken as constant. It has a value at radius 0, though
/// its integral around a circle vanishes there.
constexpr float kInnermost = 1e-6f;
/// Shares of probes along the two tangents and the normal.
constexpr float kAxisShare[3] = {0.25f, 0.25f, 0.5f};

}  // namespace

TabulatedBssrdf::TabulatedBssrdf(const Vec3f& p, const Vec3f& ns, const SampledSpectrum& sigma_a,
                                 const SampledSpectrum& sigma_s, const BssrdfTable* table, int left)
    : p_(p),
      frame_(Frame::from_z(ns)),
      table_(table),
      first_(left == kAllWavelengths ? 0 : left),
      wavelengths_(left == kAllWavelengths ? kSpectrumSamples : 1),
      sigma_t_(sigma_a + sigma_s) {
  const SampledSpectrum albedo = safe_div(sigma_s, sigma_t_);
  for (int i = first_; i < first_ + wavelengths_; ++i) {
    albedo_[i] = table_->albedo_weights(albedo[i]);
    const float effective = table_->effective_albedo(albedo_[i]);
    if (!(sigma_t_[i] > 0.0f) || !(effective > 0.0f)) continue;
    reach_.set(i, table_->reach(albedo_[i]) / sigma_t_[i]);
    effective_albedo_.set(i, effective);
  }
}

float TabulatedBssrdf::profile(int i, float r) const {
  const float optical = std::max(r * sigma_t_[i], kInnermost);
  const float density = table_->radial_density(albedo_[i], optical);
  if (!(density > 0.0f)) return 0.0f;
  return density / (2.0f * kPi * optical) * sqr(sigma_t_[i]);
}

float TabulatedBssrdf::pdf_r(int i, float r) const {
  return effective_albedo_[i] > 0.0f ? profile(i, r) / effective_albedo_[i] : 0.0f;
}

SampledSpectrum TabulatedBssrdf::sp(const Vec3f& p) const {
  const float r = length(p - p_);
  SampledSpectrum s;
  for (int i = first_; i < first_ + wavelengths_; ++i) s.set(i, profile(i, r));
  return s;
}

// The density p_A of [B2].
float TabulatedBssrdf::pdf_a(const Vec3f& p, const Vec3f& ng) const {
  const Vec3f d = frame_.to_local(p - p_), n = frame_.to_local(ng);
  const float r = length(d);
  const float across[3] = {std::hypot(d.y, d.z), std::hypot(d.z, d.x), std::hypot(d.x, d.y)};
  float sum = 0.0f;
  for (int i = first_; i < first_ + wavelengths_; ++i) {
    // Probes are chords of a sphere.
    if (r >= reach_[i]) continue;
    for (int axis = 0; axis < 3; ++axis)
      sum += pdf_r(i, across[axis]) * std::abs(n[axis]) * kAxisShare[axis];
  }
  return sum / static_cast<float>(wavelengths_);
}

std::optional<BssrdfProbe> TabulatedBssrdf::sample_probe(float u_axis, const Vec2f& u) const {
  int axis = 0;
  float below = 0.0f;
  while (axis < 2 && u_axis >= below + kAxisShare[axis]) below += kAxisShare[axis++];
  const float u_wavelength = (u_axis - below) / kAxisShare[axis];
  const int i = first_ + std::min(static_cast<int>(u_wavelength * static_cast<float>(wavelengths_)),
                                  wavelengths_ - 1);
  if (!(reach_[i] > 0.0f)) return std::nullopt;
  const std::optional<float> optical = table_->sample_radius(albedo_[i], u.x);
  if (!optical) return std::nullopt;
  const float r = *optical / sigma_t_[i];
  if (!(r < reach_[i])) return std::nullopt;

  const Vec3f axes[3] = {frame_.x, frame_.y, frame_.z};
  const Vec3f& along = axes[axis];
  const Vec3f& x = axes[(axis + 1) % 3];
  const Vec3f& y = axes[(axis + 2) % 3];
  const float phi = 2.0f * kPi * u.y;
  const float half = std::sqrt((reach_[i] - r) * (reach_[i] + r));
  const Vec3f middle = p_ + (x * std::cos(phi) + y * std::sin(phi)) * r;
  return BssrdfProbe{middle - along * half, middle + along * half};
}

const Bsdf* TabulatedBssrdf::exit_bsdf(BsdfArena& arena) const {
  return arena.make<NormalizedFresnelBsdf>(table_->eta());
}

}  // namespace nephroid
