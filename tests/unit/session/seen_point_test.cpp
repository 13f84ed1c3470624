// The point that a pixel sees, against a search through all triangles in double precision.
#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "session/camera_edit.h"
#include "unit/session/camera_scenes.h"

namespace nephroid {
namespace {

using testing::built;
using testing::description_of;

struct Triangle {
  Vec3d p[3];
  bool is_seen = true;  ///< false: an interface, or removed by alpha
};

std::vector<Triangle> random_triangles() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Triangle> triangles(60);
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Vec3d middle(3 * number(random), 3 * number(random), 3 * number(random));
    for (Vec3d& p : triangles[i].p)
      p = Vec3d(Vec3f(middle + Vec3d(number(random), number(random), number(random)) * 2));
    triangles[i].is_seen = i % 3 == 0;
  }
  return triangles;
}

std::string text_of(const std::vector<Triangle>& triangles) {
  std::string text = "WorldBegin\n";
  for (size_t i = 0; i < triangles.size(); ++i) {
    text += i % 3 == 1 ? "Material \"interface\"\n" : "Material \"diffuse\"\n";
    text += "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [";
    for (const Vec3d& p : triangles[i].p)
      for (int j = 0; j < 3; ++j) text += " " + std::to_string(p[j]);
    text += i % 3 == 2 ? "] \"float alpha\" 0\n" : "]\n";
  }
  return text;
}

/// Distance along the ray, or nothing (Moeller and Trumbore 1997).
std::optional<double> intersection(const Ray& ray, const Triangle& triangle) {
  const Vec3d o = to_double(ray.o), d = to_double(ray.d);
  const Vec3d e1 = triangle.p[1] - triangle.p[0], e2 = triangle.p[2] - triangle.p[0];
  const Vec3d h = d.cross(e2), s = o - triangle.p[0];
  const double det = e1.dot(h), u = s.dot(h) / det;
  const Vec3d q = s.cross(e1);
  const double v = d.dot(q) / det, t = e2.dot(q) / det;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0)) return std::nullopt;
  return t;
}

std::optional<Vec3d> first_point(const Ray& ray, const std::vector<Triangle>& triangles) {
  std::optional<double> nearest;
  for (const Triangle& triangle : triangles) {
    if (!triangle.is_seen) continue;
    const std::optional<double> t = intersection(ray, triangle);
    if (t && (!nearest || *t < *nearest)) nearest = t;
  }
  if (!nearest) return std::nullopt;
  return to_double(ray.o) + to_double(ray.d) * *nearest;
}

void expect_same_as_search(const std::string& camera) {
  const std::vector<Triangle> triangles = random_triangles();
  const auto scene = built(description_of(
      camera + " Film \"rgb\" \"integer xresolution\" 60 \"integer yresolution\" 40 " +
      text_of(triangles)));
  int seen = 0, edges = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const Vec2f centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const auto start = scene->camera->generate_ray(centre, Vec2f(0.5f, 0.5f), 0.5f);
      const std::optional<Vec3d> expected = first_point(start->ray, triangles);
      const std::optional<SeenPoint> found = seen_point(*scene, x, y);
      if (found.has_value() != expected.has_value() ||
          (found && (to_double(found->p) - *expected).length() > 1e-3)) {
        ++edges;  // rounding decides at the edge of a triangle
        continue;
      }
      if (!found) continue;
      ++seen;
      const Transform to_camera = scene->camera->camera_to_world(start->ray.time).inverted();
      EXPECT_NEAR(found->depth, to_camera.point(Vec3f(*expected)).z, 1e-3);
    }
  EXPECT_GT(seen, 60) << camera;
  EXPECT_LT(edges, 4) << camera;
}

TEST(SeenPoint, IsTheFirstSurfaceBehindInterfacesAndAlpha) {
  expect_same_as_search("LookAt 0 1 -9  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 40");
  expect_same_as_search("Scale -2 2 2 LookAt 5 5 -5  0 0 0  0 1 0 Camera \"perspective\"");
  expect_same_as_search("Scale 0.3 0.3 0.3 LookAt 0 1 -9  0 0 0  0 1 0 Camera \"orthographic\"");
  expect_same_as_search(
      "ActiveTransform EndTime Translate 2 0 0 ActiveTransform All "
      "LookAt 0 1 -9  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 40");
}

// What a pixel sees is sharp once the focus is at its depth, in a scaled camera, too: all rays of
// the lens meet there.
TEST(SeenPoint, ItsDepthIsADistanceOfTheFocus) {
  SceneDescription description = description_of(
      "Scale -3 3 3 LookAt 1 2 -8  0 0 0  0 1 0 Camera \"perspective\" \"float lensradius\" 0.5 "
      "\"float fov\" 30" +
      std::string(testing::kBall));
  const auto scene = built(description);
  const std::optional<SeenPoint> seen = seen_point(*scene, 9, 6);
  ASSERT_TRUE(seen);
  CameraPose pose = camera_pose(description, *scene);
  pose.focal_distance = seen->depth;
  set_camera(&description, pose);
  const auto sharp = built(description);
  for (const Vec2f& u : {Vec2f(0, 0), Vec2f(1, 0.3f), Vec2f(0.2f, 0.9f)}) {
    const Ray ray = sharp->camera->generate_ray(Vec2f(9.5f, 6.5f), u, 0.5f)->ray;
    const Vec3f way = seen->p - ray.o;
    EXPECT_LT(length(cross(way, ray.d)), 1e-4f);
    EXPECT_GT(length(ray.o - Vec3f(pose.eye)), 0.05f);
  }
}

TEST(SeenPoint, IsEmptyBesideTheScene) {
  const auto scene = built(description_of("LookAt 0 0 -9  0 0 0  0 1 0 Camera \"perspective\"" +
                                          std::string(testing::kBall)));
  EXPECT_FALSE(seen_point(*scene, 0, 0));
  EXPECT_TRUE(seen_point(*scene, 12, 8));
}

}  // namespace
}  // namespace nephroid
