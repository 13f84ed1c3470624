// Next-event estimation: light that reaches a vertex straight from a light that was chosen for it,
// and the densities that multiple importance sampling compares (docs/estimators.md, [D1] to [D4]).
// Who calls it: integrators. It must not know routes or films.
#pragma once

#include "transport/random_walk.h"

namespace nephroid {

/// One light sample at a vertex, not yet multiplied by any BSDF.
struct DirectSample {
  SampledSpectrum radiance;  ///< arriving unoccluded, divided by pdf_w
  Vec3f wi_world, wi;        ///< towards the light; wi is local
  float pdf_w = 0;           ///< of choosing the light and the direction
  bool delta = false;        ///< no walk can hit the light
  Ray shadow_ray;
};

/// Chooses a light and a point on it. Empty if nothing can arrive.
std::optional<DirectSample> sample_direct(const Scene& scene, const SurfaceInteraction& at,
                                          const SampledWavelengths& lambda, PathSampler& sampler);

/// Density with which sample_direct at the walk's previous vertex would have found this emitter.
float direct_pdf_w(const Scene& scene, const Walk& walk, const SurfaceInteraction& hit);
/// The same for an infinite light in the walk's direction.
float direct_pdf_w(const Scene& scene, const Walk& walk, int infinite_light);

}  // namespace nephroid
