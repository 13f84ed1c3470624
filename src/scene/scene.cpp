#include "scene/scene.h"

#include <bit>

#include "core/sampler.h"
#include "scene/camera/camera.h"
#include "scene/pixel_filter.h"

namespace nephroid {

Scene::Scene() : light_sampler(std::make_unique<LightSampler>(lights)) {}
Scene::~Scene() = default;

namespace {

// As in pbrt-v4 a hash of the ray decides alpha tests, so the same ray always sees the same.
float ray_hash(const Ray& ray) {
  uint64_t h = 0;
  for (int i = 0; i < 3; ++i) {
    h = hash_combine(h, std::bit_cast<uint32_t>(ray.o[i]));
    h = hash_combine(h, std::bit_cast<uint32_t>(ray.d[i]));
  }
  return bits_to_unit_float(static_cast<uint32_t>(h >> 32));
}

// Transforms an interaction of an instanced shape to world space. The error grows by the rounding
// of the transformed point and of later rays transformed back to object space. The matrix's
// absolute values bound both.
void to_world(const Transform& t, SurfaceInteraction& s) {
  Vec3f error;
  for (int j = 0; j < 3; ++j) {
    double carried = 0, rounded = std::abs(t.m[3][j]);
    for (int i = 0; i < 3; ++i) {
      carried += std::abs(t.m[i][j]) * s.p_error[i];
      rounded += std::abs(t.m[i][j] * s.p[i]);
    }
    error[j] = static_cast<float>(carried * (1 + gamma_bound(3)) + rounded * gamma_bound(9));
  }
  s.p = t.point(s.p);
  s.p_error = error;
  s.ng = normalize(t.normal(s.ng));
  s.dpdu = t.vector(s.dpdu);
  s.dpdv = t.vector(s.dpdv);
  s.dndu = t.normal(s.dndu);
  s.dndv = t.normal(s.dndv);
  s.shading_dpdu = t.vector(s.shading_dpdu);
  s.shading_dpdv = t.vector(s.shading_dpdv);
  const Vec3f ns = normalize(t.normal(s.shading.z));
  s.shading = Frame::from_z_and_tangent(ns, s.shading_dpdu);
}

}  // namespace

bool Scene::intersect_masked(const Ray& ray, unsigned mask, SurfaceInteraction& hit) const {
  const std::optional<EmbreeHit> found = top.accelerator->intersect(ray, mask);
  if (!found) return false;
  // Transforms the ray down to the group that was hit, and the hit back up.
  const ShapeGroup* group = &top;
  Ray local = ray;
  std::optional<Transform> placed[2];
  int depth = 0;
  for (const uint32_t number : {found->instance, found->inner}) {
    if (number == EmbreeHit::kNoInstance) break;
    const InstanceRecord& instance = group->instances[number - group->records.size()];
    placed[depth] = instance.object_to_world.at(ray.time);
    local = object_space_ray(*placed[depth++], local);
    group = instance.group;
  }
  const ShapeRecord* record = &group->records[found->geometry];
  hit.mesh = nullptr;
  record->shape->fill(found->primitive, found->uv, local, found->t, hit);
  while (depth > 0) to_world(*placed[--depth], hit);
  hit.wo = -normalize(ray.d);
  hit.time = ray.time;
  hit.distance = found->t * length(ray.d);
  hit.material = record->material;
  hit.area_light =
      record->first_light < 0 ? -1 : record->first_light + static_cast<int>(found->primitive);
  hit.shape = found->geometry;
  hit.primitive = found->primitive;
  hit.record = record;
  return true;
}

bool Scene::intersect(const Ray& ray, SurfaceInteraction& hit) const {
  Ray rest = ray;
  float passed = 0.0f;
  int passages = 0;
  while (intersect_masked(rest, kMaskAll, hit)) {
    hit.distance += passed;
    const FloatTexture* alpha = hit.record->alpha.get();
    hit.coverage = 1.0f;
    if (!alpha) return true;
    const float a = alpha->eval(TextureContext(hit));
    if (a >= 1.0f) return true;
    if (a > 0.0f && ray_hash(rest) < a) {
      hit.coverage = a;
      return true;
    }
    if (++passages > kMaxStraightEvents) return false;
    passed = hit.distance;
    rest.o = hit.spawn_origin(ray.d);
    if (rest.t_max < kInfinity) rest.t_max = ray.t_max - passed / length(ray.d);
    if (!(rest.t_max > 0.0f)) return false;
  }
  return false;
}

bool Scene::blocked(const Ray& shadow_ray) const {
  return top.accelerator->occluded(shadow_ray, kMaskOpaque);
}

bool Scene::intersect_passing(const Ray& ray, SurfaceInteraction& hit) const {
  return has_passing_shapes && intersect_masked(ray, kMaskPassing, hit);
}

Scene::Passage Scene::passage(const SurfaceInteraction& hit,
                              const SampledWavelengths& lambda) const {
  const float a = hit.record->alpha
                      ? std::clamp(hit.record->alpha->eval(TextureContext(hit)), 0.0f, 1.0f)
                      : 1.0f;
  const Material& m = *materials[hit.material]->resolve(hit);
  Passage p;
  p.beside = SampledSpectrum(1.0f - a);
  if (a > 0.0f && m.transmits_straight()) {
    p.across = m.straight_transmittance(hit, lambda) * a;
    p.across_share = a;
  }
  return p;
}

SampledSpectrum Scene::transmittance(const Ray& shadow_ray,
                                     const SampledWavelengths& lambda) const {
  if (blocked(shadow_ray)) return SampledSpectrum(0.0f);
  // Crosses the transparent surfaces one by one, each with its weight.
  SampledSpectrum weight(1.0f);
  Ray rest = shadow_ray;
  SurfaceInteraction hit;
  int passages = 0;
  while (rest.t_max > 0.0f && intersect_passing(rest, hit)) {
    if (++passages > kMaxStraightEvents) return SampledSpectrum(0.0f);
    const Passage p = passage(hit, lambda);
    weight *= p.across + p.beside;
    if (weight.is_black()) return weight;
    if (rest.t_max < kInfinity) rest.t_max -= hit.distance / length(rest.d);
    rest.o = hit.spawn_origin(rest.d);
  }
  return weight;
}

}  // namespace nephroid
