#include "photon/emission.h"

#include "transport/direct_light.h"

namespace nephroid {

namespace {

/// The way to the path's origin from outside of the scene ([P4] in docs/estimators.md), where it
/// starts in `emission.medium`.
void come_from_behind(const Scene& scene, const SampledWavelengths& lambda,
                      const PathSampler& sampler, Emission& emission) {
  Ray way = emission.ray;
  way.t_max = length(way.o - scene.sphere.center) + scene.sphere.radius;
  way.o = way.o - way.d * way.t_max;
  emission.flux *= attenuation_along(scene, way, emission.medium, lambda, sampler);
}

/// What the medium around the scene leaves of light from infinity until it reaches `ray`.
SampledSpectrum arrival(const Medium& medium, const Ray& ray, const SampledWavelengths& lambda,
                        const PathSampler& sampler) {
  Ray back = ray;
  back.d = -ray.d;
  FlightRandom random(-1.0f, hash_combine(sampler.stream_seed(), 1));
  return attenuation(medium, back, kInfinity, lambda, random, nullptr);
}

}  // namespace

std::optional<Emission> emit(const Scene& scene, const SampledWavelengths& lambda, float time,
                             PathSampler& sampler) {
  float u_light = sampler.get_1d();
  const Vec2f u_position = sampler.get_2d();
  const Vec2f u_direction = sampler.get_2d();
  const std::optional<LightChoice> choice = scene.light_sampler->sample_by_power(u_light);
  if (!choice) return std::nullopt;
  const Light& light = *scene.lights[static_cast<size_t>(choice->light)];
  const std::optional<EmissionSample> e = light.sample_emission(u_position, u_direction, lambda);
  if (!e || !(e->pdf_a > 0.0f) || !(e->pdf_w > 0.0f)) return std::nullopt;
  Emission out;
  out.light = choice->light;
  out.ray = e->ray;
  out.ray.time = time;
  out.start = *e;
  out.pdf_start = choice->pdf_p * e->pdf_a;
  if (!scene.light_media.empty()) {
    const MediumInterface& media = scene.light_media[static_cast<size_t>(choice->light)];
    out.medium = e->from_inside ? media.inside : media.outside;
  }
  out.flux = e->radiance * (e->cos_theta / (choice->pdf_p * e->pdf_a * e->pdf_w));
  // Shadow rays cross all of the medium as well.
  if (light.is_infinite() && out.medium) {
    Ray start = out.ray;
    if (e->from_behind)
      start.o = start.o - start.d * (length(start.o - scene.sphere.center) + scene.sphere.radius);
    out.flux *= arrival(*out.medium, start, lambda, sampler);
  }
  if (e->from_behind) come_from_behind(scene, lambda, sampler, out);
  if (out.flux.is_black()) return std::nullopt;
  return out;
}

}  // namespace nephroid
