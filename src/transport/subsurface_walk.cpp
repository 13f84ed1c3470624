#include "transport/subsurface_walk.h"

namespace nephroid {

std::optional<SubsurfaceExit> find_subsurface_exit(const Scene& scene,
                                                   const SurfaceInteraction& entry,
                                                   const Material& material, const Bssrdf& bssrdf,
                                                   float u_axis, const Vec2f& u_probe,
                                                   float u_choice) {
  const std::optional<BssrdfProbe> probe = bssrdf.sample_probe(u_axis, u_probe);
  if (!probe) return std::nullopt;
  Ray ray;
  ray.o = probe->start;
  ray.d = normalize(probe->end - probe->start);
  ray.t_max = length(probe->end - probe->start);
  ray.time = entry.time;

  SubsurfaceExit exit;
  SurfaceInteraction hit;
  int found = 0;
  for (int passages = 0; passages < kMaxStraightEvents && ray.t_max > 0.0f; ++passages) {
    ++exit.rays;
    if (!scene.intersect(ray, hit)) break;
    if (scene.materials[hit.material]->resolve(hit) == &material) {
      // Reservoir sampling: the n-th surface replaces the chosen one with probability 1/n. The
      // random number is rescaled.
      const float keep = 1.0f / static_cast<float>(++found);
      if (u_choice < keep) {
        exit.surface = hit;
        u_choice /= keep;
      } else {
        u_choice = (u_choice - keep) / (1.0f - keep);
      }
    }
    ray.t_max -= hit.distance;
    ray.o = hit.spawn_origin(ray.d);
  }
  if (found == 0) return std::nullopt;
  const float pdf_a = bssrdf.pdf_a(exit.surface.p, exit.surface.ng) / static_cast<float>(found);
  if (!(pdf_a > 0.0f)) return std::nullopt;
  exit.weight = bssrdf.sp(exit.surface.p) / pdf_a;
  if (exit.weight.is_black() || !exit.weight.is_finite()) return std::nullopt;
  exit.surface.wo = exit.surface.shading.z;
  exit.surface.distance = length(exit.surface.p - entry.p);
  return exit;
}

}  // namespace nephroid
