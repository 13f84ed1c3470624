// Radial profiles of light that enters a flat half space of scattering medium at one point and
// leaves it again, for all albedos of single scattering: photon beam diffusion for light scattered
// more than once, an exact integral for light scattered once. Lengths are in mean free paths. Who
// calls it: the subsurface material makes a table per (g, eta), TabulatedBssrdf reads it. It must
// not know wavelengths or units. Paper: Habel, Christensen & Jarosz, Photon Beam Diffusion, EGSR
// 2013; the sampling of radii and albedos is pbrt-v4's.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/bsdf/catmull_rom.h"

namespace nephroid {

/// Radiant exitance at distance r (> 0 or 0) of a normally incident beam of unit power: light
/// scattered once, and more than once. `albedo` in [0,1] with extinction 1, `g` in (-1,1) is the
/// mean cosine of scattering, `eta` the index of the medium over that outside. Per area, in units
/// of the mean free path.
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
  /// 2 pi r times the profile at a sample of albedo and radius.
  float profile(int albedo, int radius) const { return profile_[index(albedo, radius)]; }
  /// Integral of the profile over the plane: the albedo that the medium seems to have from outside,
  /// boundary not counted. One for each of albedos(), ascending.
  std::span<const float> effective_albedos() const { return effective_; }

  /// How to interpolate between albedos. `albedo` in [0,1].
  SplineWeights albedo_weights(float albedo) const;
  /// Interpolated 2 pi r times the profile; may be slightly below 0. 0 beyond the last radius.
  float radial_density(const SplineWeights& albedo, float r) const;
  /// Interpolated effective albedo.
  float effective_albedo(const SplineWeights& albedo) const {
    return albedo.of([this](int a) { return effective_[a]; });
  }
  /// A radius with density radial_density / effective_albedo, from u in [0,1). Empty if nothing
  /// leaves the medium.
  std::optional<float> sample_radius(const SplineWeights& albedo, float u) const;
  /// The single-scattering albedo whose effective albedo this is; 0 or 1 if there is none.
  float invert_effective_albedo(float effective) const {
    return spline_invert(albedos_, effective_, effective);
  }

 private:
  static size_t index(int albedo, int radius) {
    return static_cast<size_t>(albedo) * kRadii + radius;
  }
  void fill_row(int albedo);

  float g_, eta_;
  std::vector<float> albedos_, radii_, profile_, cumulative_, effective_;
};

/// Tables shared by the materials with the same medium.
class BssrdfTableCache {
 public:
  std::shared_ptr<const BssrdfTable> find_or_make(float g, float eta);

 private:
  std::map<std::pair<float, float>, std::shared_ptr<const BssrdfTable>> tables_;
};

}  // namespace nephroid
