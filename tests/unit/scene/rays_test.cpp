// Rays that leave a flat surface never hit it again: offsets cover the ray tracer's rounding for
// triangles and rectangles anywhere, also at coordinate zero and in instances.
#include <gtest/gtest.h>

#include "core/sampler.h"
#include "core/warps.h"
#include "input/pbrt_parser.h"
#include "scene/scene.h"
#include "unit/scene/numbers.h"

namespace nephroid {
namespace {

// Shoots rays at the plane `y = height` from above, and others away from their hits.
void expect_no_self_hits(const std::string& world, float size, float height) {
  Diagnostics diagnostics;
  const SceneDescription d =
      parse_pbrt_string("WorldBegin\n" + world, "test.pbrt", ".", diagnostics);
  const auto scene = build_scene(d, {}, diagnostics);
  Numbers u{12345};
  int landed = 0, again = 0;
  for (int i = 0; i < 20000; ++i) {
    Ray ray;
    ray.o = Vec3f((u() - 0.5f) * size, height + size * (0.01f + u()), (u() - 0.5f) * size);
    const Vec3f target((u() - 0.5f) * size, height, (u() - 0.5f) * size);
    ray.d = normalize(target - ray.o);
    SurfaceInteraction hit, other;
    if (!scene->intersect(ray, hit)) continue;
    ++landed;
    // Both sides, including grazing directions.
    Vec3f w = square_to_cosine_hemisphere({u(), u()});
    if (i % 3 == 0) w = normalize(Vec3f(w.x, w.y, w.z * 1e-3f));
    const Vec3f up = Frame::from_z(hit.ng).to_world(i % 2 ? w : -w);
    Ray away;
    away.o = hit.spawn_origin(up);
    away.d = up;
    again += scene->intersect(away, other);
  }
  EXPECT_GT(landed, 10000);
  EXPECT_EQ(again, 0);
}

std::string plane(float s, float h, bool triangles) {
  char text[400];
  if (triangles)
    std::snprintf(text, sizeof text,
                  "Shape \"trianglemesh\" \"point3 P\" [%.9g %.9g %.9g  %.9g %.9g %.9g  %.9g %.9g "
                  "%.9g  %.9g %.9g %.9g] \"integer indices\" [0 1 2 0 2 3]\n",
                  -s, h, -s, -s, h, s, s, h, s, s, h, -s);
  else
    std::snprintf(text, sizeof text,
                  "Shape \"bilinearmesh\" \"point3 P\" [%.9g %.9g %.9g  %.9g %.9g %.9g  %.9g %.9g "
                  "%.9g  %.9g %.9g %.9g]\n",
                  -s, h, -s, s, h, -s, -s, h, s, s, h, s);
  return text;
}

TEST(Rays, NeverMeetTheFlatSurfaceTheyLeave) {
  for (const bool triangles : {true, false})
    for (const float size : {1e-4f, 1.0f, 1e4f})
      for (const float height : {0.0f, 0.37f, -100.0f})
        expect_no_self_hits(plane(size, height * size, triangles), size, height * size);
}

TEST(Rays, NeverMeetTheFlatInstanceTheyLeave) {
  for (const bool triangles : {true, false})
    expect_no_self_hits("ObjectBegin \"o\"\n" + plane(1, 0.1f, triangles) +
                            "ObjectEnd\nRotate 30 0 1 0 Scale 2 2 2 Translate 0 7 0\n"
                            "ObjectInstance \"o\"\n",
                        1.5f, 14.2f);
}

TEST(Rays, ShadowRaysSeeTheLightAndWhatStandsBetween) {
  Diagnostics diagnostics;
  const SceneDescription d = parse_pbrt_string(
      "WorldBegin Material \"thindielectric\" Shape \"disk\" \"float radius\" 1 "
      "Material \"diffuse\" Translate 5 0 0 Shape \"disk\" \"float radius\" 1 "
      "Material \"interface\" Translate 5 0 0 Shape \"disk\" \"float radius\" 1",
      "test.pbrt", ".", diagnostics);
  const auto scene = build_scene(d, {}, diagnostics);
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.5f);
  Ray ray;
  ray.d = {0, 0, 4};
  ray.t_max = 1;
  ray.o = {0, 0, -2};
  // Two interfaces of index 1.5: R' = R + T^2 R / (1 - R^2) = 2R / (1 + R), R = 0.04.
  EXPECT_NEAR(scene->transmittance(ray, lambda)[0], 1 - 2 * 0.04 / 1.04, 1e-5);
  ray.o = {5, 0, -2};
  EXPECT_EQ(scene->transmittance(ray, lambda)[0], 0.0f);
  ray.o = {10, 0, -2};
  EXPECT_EQ(scene->transmittance(ray, lambda)[0], 1.0f);
  ray.o = {20, 0, -2};
  EXPECT_EQ(scene->transmittance(ray, lambda)[0], 1.0f);
  ray.o = {5, 0, -2};
  ray.t_max = 0.4f;
  EXPECT_EQ(scene->transmittance(ray, lambda)[0], 1.0f);
}

}  // namespace
}  // namespace nephroid
