#include "photon/disc_area.h"

#include <algorithm>
#include <cmath>

#include "core/warps.h"
#include "photon/merge.h"

namespace nephroid {

namespace {

/// Limit for points whose disc has next to no surface.
constexpr int kMaxProbes = 15;
/// Surfaces that one probe looks at.
constexpr int kMaxHits = 4;
/// The largest area of surface over a point of the disc. A surface may be tilted, or there may be
/// two; the series would not converge if it were 2.
constexpr float kMaxArea = 1.5f;
/// The series ends at a term below this.
constexpr float kMinTerm = 0.125f;

/// Area of the hit surface over that of its shadow on the disc; 0 if its photons are not merged.
float area_of(const Scene& scene, const SurfaceInteraction& hit, const SurfaceInteraction& center) {
  const float cosine = abs_dot(hit.ng, center.ng);
  const Material& material = *scene.materials[hit.material];
  return hit.record->merges_photons && cosine >= kMergeMinNormalCosine &&
                 (material.merging_classes() & ClassMask::kRough) != ClassMask::kNone &&
                 material.presence(hit) > 0
             ? 1 / cosine
             : 0;
}

/// Surface within `radius` of the centre on the line through the disc at `from_center`.
float area_over(const Scene& scene, const SurfaceInteraction& center, const Vec3f& from_center,
                float radius, int& rays) {
  // Room for rounding: the line of a point at the rim has no length.
  const float room = 1e-3f * radius + dot(abs(center.ng), center.p_error);
  const float height = safe_sqrt(sqr(radius) - length_squared(from_center)) + room;
  Ray ray{center.p + from_center + center.ng * height, -center.ng, 2 * height, center.time};
  SurfaceInteraction hit;
  float area = 0;
  for (int i = 0; i < kMaxHits; ++i) {
    ++rays;
    if (!scene.intersect(ray, hit)) return area;
    // What is there by chance stores photons that are as much brighter.
    area += area_of(scene, hit, center) / hit.coverage;
    ray.o = hit.spawn_origin(ray.d);
    ray.t_max -= hit.distance;
    if (area >= 1 || !(ray.t_max > 0)) return std::min(area, kMaxArea);
  }
  // Too many to tell: no correction.
  return 1;
}

}  // namespace

DiscProbes probe_disc(const Scene& scene, const SurfaceInteraction& center, float radius,
                      PathSampler sampler) {
  DiscProbes found;
  // What is stored on surfaces that are there by chance is divided by the chance, as if they were
  // whole, but rays miss them.
  if (center.coverage < 1) return found;
  const Frame frame = Frame::from_z(center.ng);
  // [W13] 1 / x = 1 + (1 - x) + (1 - x)^2 + ..., with an estimate of x for each factor. On a plane
  // that is the number of points up to the first that is covered.
  float term = 1;
  for (int i = 0; i < kMaxProbes && std::abs(term) >= kMinTerm; ++i) {
    const Vec2f d = square_to_disk(sampler.get_2d());
    const Vec3f from_center = frame.to_world(Vec3f(d.x, d.y, 0)) * radius;
    term *= 1 - area_over(scene, center, from_center, radius, found.rays);
    found.inverse_cover += term;
    if (i == 0 && term == 1) found.bias_offset = bias_factor(sqr(d.x) + sqr(d.y), 1);
  }
  found.bias_offset *= (found.inverse_cover - 1) / 2;
  return found;
}

}  // namespace nephroid
