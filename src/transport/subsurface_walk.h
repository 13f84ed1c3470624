// The exit of subsurface light: a probe ray collects surfaces of the material and chooses one. It
// must not know profiles, routes or photons.
// Papers: King et al., BSSRDF Importance Sampling, SIGGRAPH Talks 2013; Chao 1982 (reservoir
// sampling).
#pragma once

#include <optional>

#include "scene/scene.h"

namespace nephroid {

struct SubsurfaceExit {
  /// World space, not bumped. `wo` is the shading normal, since light arrives from no direction.
  /// `distance` is measured from the entry.
  SurfaceInteraction surface;
  SampledSpectrum weight;  ///< factor of the walk's throughput, [B2]
  int rays = 0;            ///< closest-hit queries
};

/// The exit of a subsurface event that enters at `entry`, a surface of `material` (resolved).
/// `u_axis`, `u_probe` and `u_choice` are random numbers in [0,1). The weight is unbiased at each
/// wavelength by itself, so Walk::density stays unchanged. Empty if the light does not come out.
std::optional<SubsurfaceExit> find_subsurface_exit(const Scene& scene,
                                                   const SurfaceInteraction& entry,
                                                   const Material& material, const Bssrdf& bssrdf,
                                                   float u_axis, const Vec2f& u_probe,
                                                   float u_choice);

}  // namespace nephroid
