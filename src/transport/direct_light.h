// Next-event estimation: light that reaches a vertex straight from a light that was chosen for it,
// and the densities that multiple importance sampling compares (docs/estimators.md, [D1] to [D4]);
// what gets along that and other straight lines. It must not know routes or films.
#pragma once

#include "transport/random_walk.h"

namespace nephroid {

/// A vertex that asks for light.
struct Receiver {
  Vec3f p;
  Vec3f ns;                                     ///< shading normal, null in a medium
  const SurfaceInteraction* surface = nullptr;  ///< null in a medium
  const Medium* medium = nullptr;               ///< around the walk that came here
  float time = 0;

  static Receiver of(const SurfaceInteraction& s, const Medium* medium) {
    return {s.p, s.shading.z, &s, medium, s.time};
  }
  static Receiver of(const MediumVertex& v, const Medium* medium) {
    return {v.p, Vec3f(0, 0, 0), nullptr, medium, v.time};
  }
};

/// One light sample at a vertex, not yet multiplied by any BSDF or phase function.
struct DirectSample {
  int light = 0;             ///< index of the light
  SampledSpectrum radiance;  ///< arriving unoccluded, divided by pdf_w
  Vec3f wi_world;            ///< unit, towards the light
  float pdf_w = 0;           ///< of choosing the light and the direction
  bool delta = false;        ///< no walk can hit the light
  Vec3f p, ng;               ///< point and outside normal of the light, null if it has none
  Ray shadow_ray;
  const Medium* medium = nullptr;  ///< in which the shadow ray starts
};

/// Chooses a light and a point on it. Empty if nothing can arrive.
std::optional<DirectSample> sample_direct(const Scene& scene, const Receiver& at,
                                          const SampledWavelengths& lambda, PathSampler& sampler);

/// What arrives of a light sample through everything on its way, media included, and how likely
/// either technique is to find it there ([V5]). Random numbers come from the sampler's current
/// dimension.
ShadowFlight trace_shadow(const Scene& scene, const DirectSample& direct,
                          const SampledWavelengths& lambda, const PathSampler& sampler);

/// What gets along a ray of unit direction through everything on its way, without any density that
/// depends on the wavelength: for photons. `medium` is the one around the origin, and becomes the
/// one around the end.
SampledSpectrum attenuation_along(const Scene& scene, const Ray& ray, const Medium*& medium,
                                  const SampledWavelengths& lambda, const PathSampler& sampler);

/// The same from a light sample's vertex to its light.
SampledSpectrum attenuation_to_light(const Scene& scene, const DirectSample& direct,
                                     const SampledWavelengths& lambda, const PathSampler& sampler);

/// The same between two points, off their surfaces already; `medium` is the one at `from`. Black if
/// they are one.
SampledSpectrum attenuation_between(const Scene& scene, const Vec3f& from, const Vec3f& to,
                                    float time, const Medium* medium,
                                    const SampledWavelengths& lambda, const PathSampler& sampler);

/// Density with which sample_direct at the walk's previous vertex would have found this emitter.
float direct_pdf_w(const Scene& scene, const Walk& walk, const SurfaceInteraction& hit);
/// The same for an infinite light in the walk's direction.
float direct_pdf_w(const Scene& scene, const Walk& walk, int infinite_light);

}  // namespace nephroid
