#include "transport/direct_light.h"

namespace nephroid {

std::optional<DirectSample> sample_direct(const Scene& scene, const Receiver& at,
                                          const SampledWavelengths& lambda, PathSampler& sampler) {
  const float u_light = sampler.get_1d();
  const Vec2f u = sampler.get_2d();
  const std::optional<LightChoice> choice = scene.light_sampler->sample(at.p, at.ns, u_light);
  if (!choice) return std::nullopt;
  return sample_direct(scene, at, *choice, u, lambda);
}

std::optional<DirectSample> sample_direct(const Scene& scene, const Receiver& at,
                                          LightChoice choice, const Vec2f& u,
                                          const SampledWavelengths& lambda) {
  const Light& light = *scene.lights[choice.light];
  const std::optional<LightSample> s = light.sample_towards(at.p, u, lambda);
  if (!s || !(s->pdf_w > 0.0f) || s->radiance.is_black()) return std::nullopt;
  return direct_sample(at, choice.light, *s, choice.pdf_p * s->pdf_w);
}

DirectSample direct_sample(const Receiver& at, int light, const LightSample& s, float pdf_w) {
  DirectSample d;
  d.light = light;
  d.pdf_w = pdf_w;
  d.radiance = s.radiance / pdf_w;
  d.wi_world = s.wi;
  d.delta = s.delta;
  d.p = s.p;
  d.ng = s.ng;
  d.medium = at.surface ? medium_towards(*at.surface, s.wi, at.medium) : at.medium;
  // Both ends are offset by their own error bounds. The margin on t_max keeps the ray from reaching
  // the emitter itself.
  d.shadow_ray.o = at.surface ? at.surface->spawn_origin(s.wi) : at.p;
  d.shadow_ray.time = at.time;
  if (s.infinite) {
    d.shadow_ray.d = s.wi;
    return d;
  }
  const Vec3f end = length_squared(s.ng) > 0 ? offset_ray_origin(s.p, s.p_error, s.ng, -s.wi) : s.p;
  d.shadow_ray.d = end - d.shadow_ray.o;
  d.shadow_ray.t_max = 1.0f - 1e-5f;
  return d;
}

namespace {

// Transmittance along an unblocked ray of unit direction, piece by piece between the surfaces that
// let light through. `piece(medium, ray, t_max)` is the transmittance of a medium; `medium` becomes
// the one around the end of the ray.
template <class Piece>
SampledSpectrum follow(const Scene& scene, Ray rest, const Medium*& medium,
                       const SampledWavelengths& lambda, FlightRandom& random, Piece&& piece) {
  SampledSpectrum through(1.0f);
  SurfaceInteraction hit;
  for (int passages = 0; rest.t_max > 0.0f; ++passages) {
    const bool found = scene.intersect_passing(rest, hit);
    if (medium) through *= piece(*medium, rest, found ? hit.distance : rest.t_max);
    if (!found || through.is_black()) return through;
    if (passages >= kMaxStraightEvents) return SampledSpectrum(0.0f);
    // Light that passes by alpha stays in its medium, as walks do.
    const Scene::Passage passage = scene.passage(hit, lambda);
    const bool crosses = passage.across_share > 0.0f && random.next() < passage.across_share;
    through *= crosses ? passage.across / passage.across_share
                       : passage.beside / (1.0f - passage.across_share);
    if (through.is_black()) return through;
    if (crosses) medium = medium_towards(hit, rest.d, medium);
    if (rest.t_max < kInfinity) rest.t_max -= hit.distance;
    rest.o = hit.spawn_origin(rest.d);
  }
  return through;
}

/// The shadow ray, rescaled to a direction of unit length.
Ray unit_shadow_ray(const DirectSample& direct) {
  Ray ray = direct.shadow_ray;
  const float unit = length(ray.d);
  ray.d = ray.d / unit;
  ray.t_max *= unit;
  return ray;
}

}  // namespace

ShadowFlight trace_shadow(const Scene& scene, const DirectSample& direct,
                          const SampledWavelengths& lambda, const PathSampler& sampler) {
  ShadowFlight flight;
  if (scene.media.empty()) {
    flight.transmittance = scene.transmittance(direct.shadow_ray, lambda);
    return flight;
  }
  if (scene.blocked(direct.shadow_ray)) {
    flight.transmittance = SampledSpectrum(0.0f);
    return flight;
  }
  FlightRandom random(-1.0f, sampler.stream_seed());
  const Medium* medium = direct.medium;
  const SampledSpectrum surfaces =
      follow(scene, unit_shadow_ray(direct), medium, lambda, random,
             [&](const Medium& m, const Ray& piece, float t_max) {
               cross(m, piece, t_max, lambda, random, flight);
               return SampledSpectrum(flight.transmittance.is_black() ? 0.0f : 1.0f);
             });
  flight.transmittance *= surfaces;
  return flight;
}

SampledSpectrum attenuation_along(const Scene& scene, const Ray& ray, const Medium*& medium,
                                  const SampledWavelengths& lambda, const PathSampler& sampler) {
  if (scene.blocked(ray)) return SampledSpectrum(0.0f);
  FlightRandom random(-1.0f, sampler.stream_seed());
  return follow(scene, ray, medium, lambda, random,
                [&](const Medium& m, const Ray& piece, float t_max) {
                  return attenuation(m, piece, t_max, lambda, random, nullptr);
                });
}

SampledSpectrum attenuation_to_light(const Scene& scene, const DirectSample& direct,
                                     const SampledWavelengths& lambda, const PathSampler& sampler) {
  if (scene.media.empty()) return scene.transmittance(direct.shadow_ray, lambda);
  const Medium* medium = direct.medium;
  return attenuation_along(scene, unit_shadow_ray(direct), medium, lambda, sampler);
}

SampledSpectrum attenuation_between(const Scene& scene, const Vec3f& from, const Vec3f& to,
                                    float time, const Medium* medium,
                                    const SampledWavelengths& lambda, const PathSampler& sampler) {
  const Vec3f way = to - from;
  const float distance = length(way);
  if (!(distance > 0.0f)) return SampledSpectrum(0.0f);
  Ray ray;
  ray.o = from;
  ray.d = way / distance;
  ray.t_max = distance * (1.0f - 1e-5f);
  ray.time = time;
  if (scene.media.empty()) return scene.transmittance(ray, lambda);
  return attenuation_along(scene, ray, medium, lambda, sampler);
}

float direct_pdf_w(const Scene& scene, const Walk& walk, const SurfaceInteraction& hit) {
  const Light& light = *scene.lights[hit.area_light];
  return scene.light_sampler->pmf(walk.previous_p, walk.previous_ns, hit.area_light) *
         light.pdf_towards(walk.previous_p, walk.ray.d, hit.p, hit.ng);
}

float direct_pdf_w(const Scene& scene, const Walk& walk, int infinite_light) {
  const Light& light = *scene.lights[infinite_light];
  return scene.light_sampler->pmf(walk.previous_p, walk.previous_ns, infinite_light) *
         light.pdf_towards(walk.previous_p, walk.ray.d, Vec3f(0, 0, 0), Vec3f(0, 0, 0));
}

}  // namespace nephroid
