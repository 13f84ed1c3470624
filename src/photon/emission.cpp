#include "photon/emission.h"

#include <cmath>

#include "transport/direct_light.h"

namespace nephroid {

namespace {

/// Multiplies the flux by the transmittance from outside of the scene to the path's origin ([P4] in
/// docs/estimators.md). The way starts in `emission.medium`.
void come_from_behind(const Scene& scene, const SampledWavelengths& lambda,
                      const PathSampler& sampler, Emission& emission) {
  Ray way = emission.ray;
  way.t_max = length(way.o - scene.sphere.center) + scene.sphere.radius;
  way.o = way.o - way.d * way.t_max;
  emission.flux *= attenuation_along(scene, way, emission.medium, lambda, sampler);
}

/// Transmittance of the medium around the scene, from infinity to the ray's origin.
SampledSpectrum arrival(const Medium& medium, const Ray& ray, const SampledWavelengths& lambda,
                        const PathSampler& sampler) {
  Ray back = ray;
  back.d = -ray.d;
  FlightRandom random(-1.0f, hash_combine(sampler.stream_seed(), 1));
  return attenuation(medium, back, kInfinity, lambda, random, nullptr);
}

/// Intensity of a point light in a direction, per steradian.
SampledSpectrum intensity(const Light& light, const Vec3f& p, const Vec3f& w,
                          const SampledWavelengths& lambda) {
  // Far enough for the direction to survive rounding.
  const float distance = 1 + std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
  const auto seen = light.sample_towards(p + w * distance, {0.5f, 0.5f}, lambda);
  return seen ? seen->radiance * sqr(distance) : SampledSpectrum();
}

/// Guides a start to a target. The densities become those with which the light itself would sample
/// the new start.
void aim(const Scene& scene, const Light& light, const EmissionGuide& guide, int target,
         const Vec2f& u_position, const Vec2f& u_direction, const SampledWavelengths& lambda,
         EmissionSample& e) {
  if (light.is_infinite()) {
    if (!light.emits_through_disk()) return;
    const Vec3f o = guide.point_across(target, e.ray.d, u_position);
    e.ray.o = o - e.ray.d * (dot(o - scene.sphere.center, e.ray.d) + scene.sphere.radius);
    return;
  }
  const auto w = guide.direction_to(target, light.is_area() ? e.p : e.ray.o, u_direction);
  if (!w) return;
  e.ray.d = *w;
  e.pdf_w = light.emission_pdf(e.ng, *w).pdf_w;
  if (light.is_area()) {
    e.ray.o = offset_ray_origin(e.p, e.p_error, e.ng, *w);
    e.cos_theta = abs_dot(e.ng, *w);
    e.from_inside = dot(e.ng, *w) < 0.0f;
  } else {
    e.radiance = intensity(light, e.ray.o, *w, lambda);
  }
}

}  // namespace

std::optional<Emission> emit(const Scene& scene, const EmissionGuide& guide,
                             const SampledWavelengths& lambda, float time, PathSampler& sampler) {
  const float u_light = sampler.get_1d();
  const Vec2f u_position = sampler.get_2d();
  const Vec2f u_direction = sampler.get_2d();
  const auto choice = guide.choose(scene, u_light);
  if (!choice) return std::nullopt;
  const Light& light = *scene.lights[choice->light];
  std::optional<EmissionSample> e = light.sample_emission(u_position, u_direction, lambda);
  if (!e || !(e->pdf_a > 0.0f)) return std::nullopt;
  if (choice->target >= 0)
    aim(scene, light, guide, choice->target, u_position, u_direction, lambda, *e);
  if (!(e->pdf_w > 0.0f)) return std::nullopt;
  Emission out;
  out.light = choice->light;
  out.ray = e->ray;
  out.ray.time = time;
  out.start = *e;
  const float pmf = scene.light_sampler->pmf_by_power(choice->light);
  out.pdf_start = pmf * static_cast<float>(guide.gain(choice->light)) * e->pdf_a;
  if (!scene.light_media.empty()) {
    const MediumInterface& media = scene.light_media[choice->light];
    out.medium = e->from_inside ? media.inside : media.outside;
  }
  // [G1]
  const double own = light.is_infinite() ? e->pdf_a : e->pdf_w;
  const double others = light.is_infinite() ? e->pdf_w : e->pdf_a;
  const double guided = guide.density(scene, choice->light, light.is_area() ? e->p : e->ray.o,
                                      e->ray.d, own, choice->target);
  out.weight = static_cast<float>(own / guided);
  out.flux = e->radiance * (e->cos_theta / static_cast<float>(pmf * others * guided));
  // As next-event estimation does: its shadow rays cross all of the medium.
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
