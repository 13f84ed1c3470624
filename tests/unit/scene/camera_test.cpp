// Cameras: rays through known film points, the thin lens, the pixel footprint.
#include "scene/camera.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"

namespace nephroid {
namespace {

std::unique_ptr<Camera> camera(const std::string& text, int width, int height) {
  Diagnostics diagnostics;
  const SceneDescription d = parse_pbrt_string(text + "\nWorldBegin", "test.pbrt", ".", diagnostics);
  return make_camera(d.camera, width, height, diagnostics);
}

constexpr Vec2f kNoLens(0.5f, 0.5f);

void expect_near(const Vec3f& a, const Vec3f& b) {
  EXPECT_LT(length(a - b), 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Camera, PerspectiveFieldOfViewSpansTheShorterSide) {
  const auto c = camera("Camera \"perspective\" \"float fov\" 90", 200, 100);
  expect_near(c->generate_ray({100, 50}, kNoLens, 0).d, {0, 0, 1});
  expect_near(c->generate_ray({100, 0}, kNoLens, 0).d, normalize(Vec3f(0, 1, 1)));
  expect_near(c->generate_ray({200, 50}, kNoLens, 0).d, normalize(Vec3f(2, 0, 1)));
  EXPECT_NEAR(c->footprint().width(10), 10 * 2.0 / 100, 1e-5);
}

TEST(Camera, LookAtPlacesIt) {
  const auto c = camera("LookAt 1 2 3  1 2 10  0 1 0 Camera \"perspective\"", 64, 64);
  const Ray r = c->generate_ray({32, 32}, kNoLens, 0);
  expect_near(r.o, {1, 2, 3});
  expect_near(r.d, {0, 0, 1});
}

TEST(Camera, OrthographicRaysAreParallel) {
  const auto c = camera("Camera \"orthographic\" \"float screenwindow\" [-3 3 -2 2]", 60, 40);
  const Ray r = c->generate_ray({60, 0}, kNoLens, 0);
  expect_near(r.o, {3, 2, 0});
  expect_near(r.d, {0, 0, 1});
  EXPECT_NEAR(c->footprint().width(123), 0.1, 1e-6);
}

TEST(Camera, LensRaysMeetOnThePlaneOfFocus) {
  const auto c = camera(
      "Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.3 \"float focaldistance\" 5", 64,
      64);
  const Ray sharp = camera("Camera \"perspective\" \"float fov\" 40", 64, 64)
                        ->generate_ray({10, 20}, kNoLens, 0);
  const Vec3f focus = sharp.o + sharp.d * (5 / sharp.d.z);
  for (const Vec2f& u : {Vec2f(0.1f, 0.9f), Vec2f(0.99f, 0.5f), Vec2f(0.3f, 0.01f)}) {
    const Ray r = c->generate_ray({10, 20}, u, 0);
    EXPECT_GT(length(r.o), 0.01f);
    expect_near(r.o + r.d * ((5 - r.o.z) / r.d.z), focus);
  }
}

TEST(Camera, ShutterMapsTime) {
  const auto c = camera("Camera \"perspective\" \"float shutteropen\" 0.2 \"float shutterclose\" 0.6", 8, 8);
  EXPECT_NEAR(c->generate_ray({1, 1}, kNoLens, 0.5f).time, 0.4, 1e-6);
}

TEST(Camera, WrongOnesAreRefused) {
  EXPECT_THROW(camera("Camera \"perspective\" \"float fov\" 0", 8, 8), SceneError);
  EXPECT_THROW(camera("Camera \"fisheye\"", 8, 8), SceneError);
  EXPECT_THROW(camera("Camera \"perspective\" \"float lensradius\" -1", 8, 8), SceneError);
}

}  // namespace
}  // namespace nephroid
