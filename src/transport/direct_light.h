// Next-event estimation: samples a light for a vertex, and gives the densities for multiple
// importance sampling (docs/estimators.md, [D1] to [D4]). Also the transmittance along straight
// lines. It must not know routes or films.
#pragma once

#include "transport/walk.h"

namespace nephroid {

/// A vertex that receives light.
struct Receiver {
  Vec3f p;
  Vec3f ns;                                     ///< shading normal, null in a medium
  const SurfaceInteraction* surface = nullptr;  ///< null in a medium
  const Medium* medium = nullptr;               ///< medium through which the walk arrived
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
  float pdf_w = 0;           ///< density of the light and the direction, per steradian
  bool delta = false;        ///< no walk can hit the light
  Vec3f p, ng;               ///< point and outside normal of the light, null if it has none
  Ray shadow_ray;
  const Medium* medium = nullptr;  ///< medium at the start of the shadow ray
};

/// Samples a light and a point on it. Empty if no light can arrive.
std::optional<DirectSample> sample_direct(const Scene& scene, const Receiver& at,
                                          const SampledWavelengths& lambda, PathSampler& sampler);

/// The same for a light that was chosen with the probability `pdf_p`.
std::optional<DirectSample> sample_direct(const Scene& scene, const Receiver& at,
                                          LightChoice choice, const Vec2f& u,
                                          const SampledWavelengths& lambda);

/// The light sample of light number `light`, with the density `pdf_w` of both.
DirectSample direct_sample(const Receiver& at, int light, const LightSample& sample, float pdf_w);

/// Transmittance from a vertex to its light sample, media included, with the densities of both
/// techniques ([V5]). Random numbers come from the sampler's current dimension.
ShadowFlight trace_shadow(const Scene& scene, const DirectSample& direct,
                          const SampledWavelengths& lambda, const PathSampler& sampler);

/// Transmittance along a ray of unit direction, media included. No density depends on the
/// wavelength, as photons need it. `medium` is the one around the origin and becomes the one around
/// the end.
SampledSpectrum attenuation_along(const Scene& scene, const Ray& ray, const Medium*& medium,
                                  const SampledWavelengths& lambda, const PathSampler& sampler);

/// The same from a light sample's vertex to its light.
SampledSpectrum attenuation_to_light(const Scene& scene, const DirectSample& direct,
                                     const SampledWavelengths& lambda, const PathSampler& sampler);

/// The same between two points, already offset from their surfaces; `medium` is the one at `from`.
/// Black if the points coincide.
SampledSpectrum attenuation_between(const Scene& scene, const Vec3f& from, const Vec3f& to,
                                    float time, const Medium* medium,
                                    const SampledWavelengths& lambda, const PathSampler& sampler);

/// Density with which sample_direct at the walk's previous vertex would have found this emitter.
float direct_pdf_w(const Scene& scene, const Walk& walk, const SurfaceInteraction& hit);
/// The same for an infinite light in the walk's direction.
float direct_pdf_w(const Scene& scene, const Walk& walk, int infinite_light);

}  // namespace nephroid
