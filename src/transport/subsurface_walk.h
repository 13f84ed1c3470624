// Where light that went into a subsurface material comes out again: a probe ray through the scene
// collects the surfaces of that material, and one of them is chosen. It must not know profiles,
// routes or photons. Papers: King et al., BSSRDF Importance Sampling, SIGGRAPH Talks 2013; Chao
// 1982 (choice of one in a single pass).
#pragma once

#include <optional>

#include "scene/scene.h"

namespace nephroid {

struct SubsurfaceExit {
  /// World space, not bumped; wo is the shading normal, since the light came from no direction;
  /// `distance` is that from the entry.
  SurfaceInteraction surface;
  SampledSpectrum weight;  ///< what the walk's throughput is multiplied by, [B2]
  int rays = 0;            ///< closest-hit queries
};

/// The other end of a subsurface event at `entry`, a surface of `material` (resolved). `u_axis`,
/// `u_probe` and `u_choice` in [0,1) are the random numbers. The weight is an unbiased estimate at
/// each of the path's wavelengths by itself, so whatever ratios of densities a walk carries stay as
/// they are. Empty if the light does not come out.
std::optional<SubsurfaceExit> find_subsurface_exit(const Scene& scene,
                                                   const SurfaceInteraction& entry,
                                                   const Material& material, const Bssrdf& bssrdf,
                                                   float u_axis, const Vec2f& u_probe,
                                                   float u_choice);

}  // namespace nephroid
