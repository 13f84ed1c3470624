// Perspective and orthographic cameras: rays through known film points, the thin lens, pixel
// footprints, the shutter and moving cameras.
#include "unit/camera/camera_fixture.h"

namespace nephroid {
namespace {

using testing_support::camera_of;
using testing_support::expect_near;
using testing_support::ray_of;

constexpr Vec2f kNoLens(0.5f, 0.5f);

TEST(Camera, PerspectiveFieldOfViewSpansTheShorterSide) {
  const auto c = camera_of("Camera \"perspective\" \"float fov\" 90", 200, 100);
  expect_near(ray_of(*c, {100, 50}, kNoLens, 0).d, {0, 0, 1});
  expect_near(ray_of(*c, {100, 0}, kNoLens, 0).d, normalize(Vec3f(0, 1, 1)));
  expect_near(ray_of(*c, {200, 50}, kNoLens, 0).d, normalize(Vec3f(2, 0, 1)));
  EXPECT_NEAR(c->footprint().width(10), 10 * 2.0 / 100, 1e-5);
}

TEST(Camera, LookAtPlacesIt) {
  const auto c = camera_of("LookAt 1 2 3  1 2 10  0 1 0 Camera \"perspective\"", 64, 64);
  const Ray r = ray_of(*c, {32, 32}, kNoLens, 0);
  expect_near(r.o, {1, 2, 3});
  expect_near(r.d, {0, 0, 1});
}

TEST(Camera, OrthographicRaysAreParallel) {
  const auto c = camera_of("Camera \"orthographic\" \"float screenwindow\" [-3 3 -2 2]", 60, 40);
  const Ray r = ray_of(*c, {60, 0}, kNoLens, 0);
  expect_near(r.o, {3, 2, 0});
  expect_near(r.d, {0, 0, 1});
  EXPECT_NEAR(c->footprint().width(123), 0.1, 1e-6);
}

TEST(Camera, LensRaysMeetOnThePlaneOfFocus) {
  const auto c = camera_of(
      "Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.3 \"float focaldistance\" 5",
      64, 64);
  const Ray sharp =
      ray_of(*camera_of("Camera \"perspective\" \"float fov\" 40", 64, 64), {10, 20}, kNoLens, 0);
  const Vec3f focus = sharp.o + sharp.d * (5 / sharp.d.z);
  for (const Vec2f& u : {Vec2f(0.1f, 0.9f), Vec2f(0.99f, 0.5f), Vec2f(0.3f, 0.01f)}) {
    const Ray r = ray_of(*c, {10, 20}, u, 0);
    EXPECT_GT(length(r.o), 0.01f);
    expect_near(r.o + r.d * ((5 - r.o.z) / r.d.z), focus);
  }
}

// The lens of an orthographic camera is on the axis, as in pbrt-v4.
TEST(Camera, OrthographicLens) {
  const auto c = camera_of(
      "Camera \"orthographic\" \"float lensradius\" 0.3 \"float focaldistance\" 5", 64, 64);
  for (const Vec2f& u : {Vec2f(0.1f, 0.9f), Vec2f(0.99f, 0.5f)}) {
    const Ray r = ray_of(*c, {48, 16}, u, 0);
    EXPECT_LE(length(r.o), 0.3001f);
    expect_near(r.o + r.d * (5 / r.d.z), Vec3f(0.5f, 0.5f, 5));
  }
  EXPECT_NEAR(c->footprint().width(5), 2.0 / 64, 1e-6);
}

TEST(Camera, TimeCountsBetweenTheKeyframes) {
  const std::string shutter =
      "Camera \"perspective\" \"float shutteropen\" 0.2 \"float shutterclose\" 0.6";
  EXPECT_NEAR(camera_of(shutter, 8, 8)->motion_time(0.5f), 0.4, 1e-6);
  EXPECT_NEAR(ray_of(*camera_of(shutter, 8, 8), {1, 1}, kNoLens, 0.5f).time, 0.4, 1e-6);
  EXPECT_NEAR(camera_of("TransformTimes 0.3 0.5 " + shutter, 8, 8)->motion_time(0.5f), 0.5, 1e-5);
  EXPECT_EQ(camera_of("TransformTimes 0.3 0.5 " + shutter, 8, 8)->motion_time(0.1f), 0.0f);
  EXPECT_EQ(camera_of("TransformTimes 0.3 0.5 " + shutter, 8, 8)->motion_time(0.9f), 1.0f);
  EXPECT_EQ(camera_of("TransformTimes 0.3 0.3 " + shutter, 8, 8)->motion_time(0.9f), 0.0f);
}

TEST(Camera, MovesFromItsFirstKeyframeToItsSecond) {
  const auto c = camera_of(
      "ActiveTransform EndTime Translate -4 0 0 ActiveTransform All Camera \"perspective\" "
      "\"float shutterclose\" 2",
      8, 8);
  expect_near(ray_of(*c, {4, 4}, kNoLens, 0).o, {0, 0, 0});
  expect_near(ray_of(*c, {4, 4}, kNoLens, 0.25f).o, {2, 0, 0});
  expect_near(ray_of(*c, {4, 4}, kNoLens, 0.5f).o, {4, 0, 0});
  expect_near(ray_of(*c, {4, 4}, kNoLens, 0.75f).o, {4, 0, 0});
}

TEST(Camera, WrongOnesAreRefused) {
  EXPECT_THROW(camera_of("Camera \"perspective\" \"float fov\" 0", 8, 8), SceneError);
  EXPECT_THROW(camera_of("Camera \"fisheye\"", 8, 8), SceneError);
  EXPECT_THROW(camera_of("Camera \"perspective\" \"float lensradius\" -1", 8, 8), SceneError);
}

}  // namespace
}  // namespace nephroid
