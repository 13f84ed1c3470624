// How much surface lies in the disc in which photons are merged. At an edge it is a part of the
// disc: divided by all of it, the light of the photons would be too dark ([W13] in
// docs/estimators.md). It must not know what the photons carry.
#pragma once

#include "core/sampler.h"
#include "scene/scene.h"

namespace nephroid {

/// Estimates from a few rays through the disc of a merge.
struct DiscProbes {
  /// Area of the disc over the area of the surface in it; its mean is within 1 % where at least a
  /// quarter of the disc is covered, and too small below.
  float inverse_cover = 1;
  float bias_offset = 0;  ///< [W14], to be added to bias_factor() of each photon
  int rays = 0;
};

/// Probes the disc of a merge around a point of a surface, in its tangent plane; `radius` in world
/// units. Only surfaces count that may store photons which are merged at the point. A function of
/// its arguments alone.
DiscProbes probe_disc(const Scene& scene, const SurfaceInteraction& center, float radius,
                      PathSampler sampler);

}  // namespace nephroid
