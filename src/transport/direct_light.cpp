#include "transport/direct_light.h"

namespace nephroid {

std::optional<DirectSample> sample_direct(const Scene& scene, const SurfaceInteraction& at,
                                          const SampledWavelengths& lambda, PathSampler& sampler) {
  const float u_light = sampler.get_1d();
  const Vec2f u = sampler.get_2d();
  const std::optional<LightChoice> choice =
      scene.light_sampler->sample(at.p, at.shading.z, u_light);
  if (!choice) return std::nullopt;
  const Light& light = *scene.lights[static_cast<size_t>(choice->light)];
  const std::optional<LightSample> s = light.sample_towards(at.p, u, lambda);
  if (!s || !(s->pdf_w > 0.0f) || s->radiance.is_black()) return std::nullopt;
  DirectSample d;
  d.pdf_w = choice->pdf_p * s->pdf_w;
  d.radiance = s->radiance / d.pdf_w;
  d.wi_world = s->wi;
  d.wi = at.shading.to_local(s->wi);
  d.delta = s->delta;
  // Both ends leave their surfaces by their own error bounds; the tiny margin keeps the ray from
  // reaching the emitter itself.
  d.shadow_ray.o = at.spawn_origin(s->wi);
  d.shadow_ray.time = at.time;
  if (s->infinite) {
    d.shadow_ray.d = s->wi;
    return d;
  }
  const Vec3f end =
      length_squared(s->ng) > 0 ? offset_ray_origin(s->p, s->p_error, s->ng, -s->wi) : s->p;
  d.shadow_ray.d = end - d.shadow_ray.o;
  d.shadow_ray.t_max = 1.0f - 1e-5f;
  return d;
}

float direct_pdf_w(const Scene& scene, const Walk& walk, const SurfaceInteraction& hit) {
  const Light& light = *scene.lights[static_cast<size_t>(hit.area_light)];
  return scene.light_sampler->pmf(walk.previous_p, walk.previous_ns, hit.area_light) *
         light.pdf_towards(walk.previous_p, walk.ray.d, hit.p, hit.ng);
}

float direct_pdf_w(const Scene& scene, const Walk& walk, int infinite_light) {
  const Light& light = *scene.lights[static_cast<size_t>(infinite_light)];
  return scene.light_sampler->pmf(walk.previous_p, walk.previous_ns, infinite_light) *
         light.pdf_towards(walk.previous_p, walk.ray.d, Vec3f(0, 0, 0), Vec3f(0, 0, 0));
}

}  // namespace nephroid
