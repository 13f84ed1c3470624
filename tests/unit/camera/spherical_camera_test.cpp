// The spherical camera: known directions, equal areas, and filters that cross the edges.
#include "unit/camera/camera_fixture.h"

namespace nephroid {
namespace {

using testing_support::camera_error;
using testing_support::camera_of;
using testing_support::expect_near;
using testing_support::ray_of;

constexpr Vec2f kLens(0.5f, 0.5f);

TEST(SphericalCamera, Equirectangular) {
  const auto c = camera_of("Camera \"spherical\" \"string mapping\" \"equirectangular\"", 80, 40);
  expect_near(ray_of(*c, {33, 0}, kLens, 0).d, {0, 1, 0});
  expect_near(ray_of(*c, {33, 40}, kLens, 0).d, {0, -1, 0});
  expect_near(ray_of(*c, {0, 20}, kLens, 0).d, {1, 0, 0});
  expect_near(ray_of(*c, {20, 20}, kLens, 0).d, {0, 0, 1});
  expect_near(ray_of(*c, {40, 20}, kLens, 0).d, {-1, 0, 0});
  expect_near(ray_of(*c, {60, 20}, kLens, 0).d, {0, 0, -1});
  EXPECT_NEAR(c->footprint().spread, 2 * std::sin(kPi / 80), 1e-5);
  EXPECT_EQ(c->footprint().offset, 0.0f);
}

TEST(SphericalCamera, EqualArea) {
  constexpr int kSize = 32;
  const auto c = camera_of("Camera \"spherical\"", kSize, kSize);
  expect_near(ray_of(*c, {16, 16}, kLens, 0).d, {0, 1, 0});
  expect_near(ray_of(*c, {0, 0}, kLens, 0).d, {0, -1, 0});
  expect_near(ray_of(*c, {32, 16}, kLens, 0).d, {1, 0, 0});
  expect_near(ray_of(*c, {16, 32}, kLens, 0).d, {0, 0, 1});
  // Every pixel sees the same solid angle, spanned by its differentials.
  constexpr float kStep = 0.01f;
  for (const Vec2f& film : {Vec2f(3.3f, 7.1f), Vec2f(20.2f, 14.6f), Vec2f(30.9f, 29.2f)}) {
    const Vec3f d = ray_of(*c, film, kLens, 0).d;
    const Vec3f dx = (ray_of(*c, film + Vec2f(kStep, 0), kLens, 0).d - d) * (1 / kStep);
    const Vec3f dy = (ray_of(*c, film + Vec2f(0, kStep), kLens, 0).d - d) * (1 / kStep);
    EXPECT_NEAR(length(cross(dx, dy)) * kSize * kSize, 4 * kPi, 0.02 * 4 * kPi);
  }
}

// Just beyond an edge the sphere continues without a jump.
TEST(SphericalCamera, FilterOverTheEdge) {
  const auto c = camera_of("Camera \"spherical\"", 64, 64);
  for (const Vec2f& edge : {Vec2f(0, 11), Vec2f(64, 50), Vec2f(22, 0), Vec2f(5, 64)})
    for (const Vec2f& step : {Vec2f(0.01f, 0), Vec2f(0, 0.01f)}) {
      const Vec3f inside = ray_of(*c, edge - step, kLens, 0).d;
      EXPECT_LT(length(ray_of(*c, edge + step, kLens, 0).d - inside), 2e-3f);
    }
}

TEST(SphericalCamera, UnknownMapping) {
  EXPECT_EQ(camera_error("Camera \"spherical\" \"string mapping\" \"mercator\""),
            "test.pbrt:1:20: unknown mapping \"mercator\" of the spherical camera, expected "
            "\"equalarea\" or \"equirectangular\"");
}

}  // namespace
}  // namespace nephroid
