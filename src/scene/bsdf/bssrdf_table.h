// Radial profiles of light that enters a flat half space of scattering medium at one point and
// leaves it at another, for all albedos. Lengths are in mean free paths. It must not know
// wavelengths or units. Papers: Habel, Christensen & Jarosz, Photon Beam Diffusion, EGSR 2013
// (multiple scattering; single scattering is exact); pbrt-v4 (sampling of radii and albedos).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/bsdf/catmull_rom.h"

namespace nephroid {

/// Radiant exitance, per area, at distance r >= 0 from a normally incident beam of unit power:
/// light scattered once, and more than once. The extinction is 1, `albedo` in [0,1]. `g` in (-1,1)
/// is the mean cosine of scattering, `eta` the index of the medium over that outside.
double beam_diffusion_single(double albedo, double g, double eta, double r);
double beam_diffusion_multiple(double albedo, double g, double eta, double r);

class BssrdfTable {
 public:
  static constexpr int kAlbedos = 100, kRadii = 64;

  BssrdfTable(float g, float eta);

  float g() const { return g_; }
  float eta() const { return eta_; }
  std::span<const float> albedos() const { return albedos_; }
  std::span<const float> radii() const { return radii_; }
  /// 2 pi r times the profile at an albedo node and a radius node.
  float profile(int albedo, int radius) const { return profile_[index(albedo, radius)]; }
  /// Integral of the profile over the plane: the albedo as seen from outside, without the boundary.
  /// One value per entry of albedos(), ascending.
  std::span<const float> effective_albedos() const { return effective_; }

  /// Interpolation weights between the albedo nodes. `albedo` in [0,1].
  SplineWeights albedo_weights(float albedo) const;
  /// Interpolated 2 pi r times the profile; can be slightly below 0. It is 0 beyond the last
  /// radius.
  float radial_density(const SplineWeights& albedo, float r) const;
  /// Interpolated effective albedo.
  float effective_albedo(const SplineWeights& albedo) const {
    return albedo.of([this](int a) { return effective_[a]; });
  }
  /// Radius that all but about 1/1000 of the light stays within.
  float reach(const SplineWeights& albedo) const {
    return albedo.of([this](int a) { return reach_[a]; });
  }
  /// Samples a radius with density radial_density / effective_albedo, from u in [0,1). Empty if no
  /// light leaves the medium.
  std::optional<float> sample_radius(const SplineWeights& albedo, float u) const;
  /// The single-scattering albedo with this effective albedo, clamped to [0,1].
  float invert_effective_albedo(float effective) const {
    return spline_invert(albedos_, effective_, effective);
  }

 private:
  static size_t index(int albedo, int radius) {
    return static_cast<size_t>(albedo) * kRadii + radius;
  }
  void fill_row(int albedo);

  float g_, eta_;
  std::vector<float> albedos_, radii_, profile_, cumulative_, effective_, reach_;
};

/// Tables shared by materials with the same medium.
class BssrdfTableCache {
 public:
  std::shared_ptr<const BssrdfTable> find_or_make(float g, float eta);

 private:
  std::map<std::pair<float, float>, std::shared_ptr<const BssrdfTable>> tables_;
};

}  // namespace nephroid
