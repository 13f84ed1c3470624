// How much of the disc in which photons are merged is surface. Beside an edge it is a part of it,
// photons lie on that part alone, and their light divided by the whole disc would be too dark
// ([W13] in docs/estimators.md). It must not know photons.
#pragma once

#include "core/sampler.h"
#include "scene/scene.h"

namespace nephroid {

/// What probing a disc told.
struct DiscProbes {
  /// Area of the disc over that of the surface in it: right in the mean where at least a tenth of
  /// the disc is covered, too small below. Never below 1.
  float inverse_cover = 1;
  int rays = 0;
};

/// Probes the disc of a merge around a point of a surface, in its tangent plane; `radius` in world
/// units. Only surfaces count on which photons of the point's neighbourhood may lie and are merged.
/// A function of its arguments alone.
DiscProbes probe_disc(const Scene& scene, const SurfaceInteraction& center, float radius,
                      PathSampler sampler);

}  // namespace nephroid
