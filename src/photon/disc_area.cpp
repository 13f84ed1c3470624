#include "photon/disc_area.h"

#include "core/warps.h"
#include "photon/merge.h"

namespace nephroid {

namespace {

/// Without an end, a point whose disc has next to no surface would be probed for ever.
constexpr int kMostProbes = 16;
/// Surfaces that one probe looks at: others lie close together only in scenes made of many sheets.
constexpr int kMostHits = 4;
/// Over the radius, squared: how far from the centre surface counts. More than 1, since a surface
/// that curves away from the tangent plane has its photons within the radius all the same.
constexpr float kReach = 1.25f;

/// True if photons may lie there and be merged at the centre.
bool may_have_photons(const Scene& scene, const SurfaceInteraction& hit,
                      const SurfaceInteraction& center) {
  return hit.record->merges_photons && abs_dot(hit.ng, center.ng) >= kMergeMinNormalCosine &&
         (scene.materials[hit.material]->merging_classes() & ClassMask::kRough) != ClassMask::kNone;
}

/// True if the line through the disc at `from_center` meets such a surface.
bool is_covered(const Scene& scene, const SurfaceInteraction& center, const Vec3f& from_center,
                float height, int& rays) {
  Ray ray{center.p + from_center + center.ng * height, -center.ng, 2 * height, center.time};
  SurfaceInteraction hit;
  for (int i = 0; i < kMostHits; ++i) {
    ++rays;
    if (!scene.intersect(ray, hit)) return false;
    if (may_have_photons(scene, hit, center)) return true;
    ray.o = hit.spawn_origin(ray.d);
    ray.t_max -= hit.distance;
    if (!(ray.t_max > 0)) return false;
  }
  return false;
}

}  // namespace

DiscProbes probe_disc(const Scene& scene, const SurfaceInteraction& center, float radius,
                      PathSampler sampler) {
  DiscProbes found;
  // What is stored on surfaces that are there by chance is divided by the chance: as if all of it
  // were there, though rays miss it.
  if (center.coverage < 1) return found;
  const Frame frame = Frame::from_z(center.ng);
  // The number of tries until the first success has the inverse of its probability for its mean.
  for (int i = 1; i <= kMostProbes; ++i) {
    found.inverse_cover = static_cast<float>(i);
    const Vec2f d = square_to_disk(sampler.get_2d());
    const float height = radius * std::sqrt(kReach - d.x * d.x - d.y * d.y);
    if (is_covered(scene, center, frame.to_world(Vec3f(d.x, d.y, 0)) * radius, height, found.rays))
      break;
  }
  return found;
}

}  // namespace nephroid
