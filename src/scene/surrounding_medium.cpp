#include "scene/surrounding_medium.h"

#include <cmath>

#include "scene/camera/camera.h"

namespace nephroid {
namespace {

/// The medium behind all surfaces on a straight line; empty if the line does not end.
std::optional<const Medium*> medium_at_the_end(const Scene& scene, Ray line) {
  const Medium* medium = scene.camera_medium;
  for (int surfaces = 0; surfaces < kMaxStraightEvents; ++surfaces) {
    SurfaceInteraction hit;
    if (!scene.intersect(line, hit)) return medium;
    medium = medium_towards(hit, line.d, medium);
    line.o = hit.spawn_origin(line.d);
  }
  return std::nullopt;
}

/// Directions of equal distances on the sphere, along a Fibonacci spiral.
Vec3f spiral_direction(int i, int count) {
  constexpr float kGoldenAngle = 2.3999632f;
  const float z = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count);
  const float phi = kGoldenAngle * static_cast<float>(i), r = std::sqrt(1.0f - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

std::optional<const Medium*> surrounding_medium(const Scene& scene) {
  constexpr int kLines = 64;
  Ray line;
  line.o = scene.camera->camera_to_world(0.0f).point(Vec3f(0, 0, 0));
  std::optional<const Medium*> common;
  for (int i = 0; i < kLines; ++i) {
    line.d = spiral_direction(i, kLines);
    const std::optional<const Medium*> medium = medium_at_the_end(scene, line);
    if (!medium) continue;
    if (common && *common != *medium) return std::nullopt;
    common = medium;
  }
  return common;
}

}  // namespace nephroid
