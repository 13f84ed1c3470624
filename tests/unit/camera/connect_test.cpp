// Camera::connect against generate_ray: the ray back passes the point, densities match its
// differentials, and all visible light is counted.
#include <random>

#include "unit/camera/camera_fixture.h"

namespace nephroid {
namespace {

using testing_support::camera_of;
using testing_support::expect_near;

constexpr int kWidth = 60, kHeight = 40;

const std::string kUneven = "Rotate 33 1 2 3 Translate 0.3 -0.2 0.4 Scale 1.5 0.7 -2 ";
const std::string kMoving =
    "ActiveTransform EndTime Translate 0.2 0.1 -0.3 Rotate 25 0 1 0 ActiveTransform All ";

// All types, with flipped screen windows, lenses, scaled and moving frames.
std::vector<std::string> cameras() {
  const std::string lens = " \"float lensradius\" 0.2 \"float focaldistance\" 3";
  std::vector<std::string> all;
  for (const std::string& frame : {std::string(), kUneven, kMoving})
    for (const std::string& camera :
         {std::string("Camera \"perspective\" \"float fov\" 50"),
          "Camera \"perspective\" \"float screenwindow\" [ 1.5 -0.5 -0.2 0.9 ]" + lens,
          std::string("Camera \"orthographic\" \"float screenwindow\" [ -2 1 2 -1 ]"),
          "Camera \"orthographic\"" + lens,
          std::string("Camera \"spherical\" \"string mapping\" \"equirectangular\""),
          std::string("Camera \"spherical\"")})
      all.push_back(frame + camera);
  return all;
}

struct Random {
  std::mt19937 engine{7};
  float next() { return std::uniform_real_distribution<float>(0.0f, kOneMinusEpsilon)(engine); }
};

TEST(CameraConnect, TheWayBackGoesThroughThePoint) {
  for (const std::string& text : cameras()) {
    const auto camera = camera_of(text, kWidth, kHeight);
    EXPECT_TRUE(camera->connects());
    Random random;
    for (int i = 0; i < 200; ++i) {
      const Vec2f film(random.next() * kWidth, random.next() * kHeight);
      const Vec2f u_lens(random.next(), random.next());
      const float u_time = random.next(), t = 0.5f + 5 * random.next();
      const Ray there = camera->generate_ray(film, u_lens, u_time)->ray;
      const Vec3f p = there.o + there.d * t;
      const auto c = camera->connect(p, u_lens, u_time);
      ASSERT_TRUE(c) << text;
      expect_near(c->p, there.o);
      expect_near(c->wi, -there.d);
      EXPECT_NEAR(c->distance, t, 1e-5f * t);
      EXPECT_LT((c->film - film).length(), 2e-3f) << text;
      EXPECT_EQ(c->weight, 1.0f);
      const auto back = camera->generate_ray(c->film, u_lens, u_time);
      expect_near(back->ray.d, there.d);
      EXPECT_EQ(back->ray.time, there.time);
    }
  }
}

TEST(CameraConnect, DensityIsTheDifferentialOfTheFilmPoint) {
  for (const std::string& text : cameras()) {
    const auto camera = camera_of(text, kWidth, kHeight);
    Random random;
    for (int i = 0; i < 30; ++i) {
      // Away from the folds of the spherical mappings.
      const Vec2f film((0.1f + 0.3f * random.next()) * kWidth,
                       (0.1f + 0.3f * random.next()) * kHeight);
      const Vec2f u_lens(random.next(), random.next());
      const float u_time = random.next(), t = 1 + 4 * random.next();
      const auto point = [&](const Vec2f& step) {
        const Ray ray = camera->generate_ray(film + step, u_lens, u_time)->ray;
        return ray.o + ray.d * t;
      };
      // Points at a constant distance from the lens, or on parallel rays, lie on a surface
      // perpendicular to the ray.
      constexpr float kStep = 0.2f;
      const Ray ray = camera->generate_ray(film, u_lens, u_time)->ray;
      const auto along = [&](const Vec2f& step) {
        const Vec3f change = (point(step) - point(-step)) * (0.5f / kStep);
        return change - ray.d * dot(change, ray.d);
      };
      const float area = length(cross(along({kStep, 0}), along({0, kStep})));
      const auto c = camera->connect(point({0, 0}), u_lens, u_time);
      ASSERT_TRUE(c);
      EXPECT_NEAR(c->film_density * area, 1.0f, 0.01f) << text;
    }
  }
}

// Points spread uniformly over a surface that fills the view cover every pixel once, for any lens.
TEST(CameraConnect, AWallCoversThePicture) {
  constexpr int kPoints = 200000;
  for (const std::string& camera_text : cameras()) {
    if (camera_text.find("spherical") != std::string::npos) continue;
    const auto camera = camera_of(camera_text, kWidth, kHeight);
    // A slanted square through the point that the film's centre sees at distance 2.
    const Ray axis = camera->generate_ray({kWidth / 2, kHeight / 2}, {0.5f, 0.5f}, 0.5f)->ray;
    const Vec3f n = normalize(axis.d + Vec3f(0.11f, 0.07f, -0.05f));
    const Frame frame = Frame::from_z(n);
    constexpr float kSide = 20;
    Random random;
    double sum = 0, squares = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Vec3f p = axis.o + axis.d * 2.0f + frame.x * (kSide * (random.next() - 0.5f)) +
                      frame.y * (kSide * (random.next() - 0.5f));
      const Vec2f u_lens(random.next(), random.next());
      const auto c = camera->connect(p, u_lens, random.next());
      if (!c || c->film.x < 0 || c->film.x >= kWidth || c->film.y < 0 || c->film.y >= kHeight)
        continue;
      const double x =
          double(c->film_density) * double(abs_dot(c->wi, n)) * double(kSide) * double(kSide);
      sum += x;
      squares += x * x;
    }
    const double mean = sum / kPoints;
    const double error = std::sqrt((squares / kPoints - mean * mean) / kPoints);
    EXPECT_LT(error, 0.05 * kWidth * kHeight) << camera_text;
    EXPECT_NEAR(mean, kWidth * kHeight, 4.5 * error) << camera_text;
  }
}

// The whole sphere of directions covers the whole picture, each half one half.
TEST(CameraConnect, TheSphereCoversThePicture) {
  for (const std::string mapping : {"equirectangular", "equalarea"}) {
    const auto camera = camera_of(
        "LookAt 1 2 3 2 2.5 3 0 0 1 Camera \"spherical\" \"string mapping\" \"" + mapping + "\"",
        kWidth, kHeight);
    constexpr int kSteps = 400;
    double sum = 0, left = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const float theta = kPi * (static_cast<float>(i) + 0.5f) / kSteps;
        const float phi = 2 * kPi * (static_cast<float>(j) + 0.5f) / kSteps;
        const float z = std::cos(theta), r = std::sin(theta);
        const Vec3f d(r * std::cos(phi), r * std::sin(phi), z);
        const auto c = camera->connect(Vec3f(1, 2, 3) + d * 3.0f, {0.5f, 0.5f}, 0);
        ASSERT_TRUE(c);
        const double x =
            double(c->film_density * 9 * r) * 2 * double(kPi * kPi) / (kSteps * kSteps);
        sum += x;
        if (c->film.x < kWidth / 2.0f) left += x;
      }
    EXPECT_NEAR(sum, kWidth * kHeight, 0.01 * kWidth * kHeight) << mapping;
    EXPECT_NEAR(left, sum / 2, 0.01 * sum) << mapping;
  }
}

TEST(CameraConnect, NothingBehindTheCamera) {
  for (const std::string type : {"perspective", "orthographic"}) {
    const auto camera = camera_of("Camera \"" + type + "\"", kWidth, kHeight);
    EXPECT_FALSE(camera->connect({0.1f, 0.2f, -1}, {0.5f, 0.5f}, 0));
    EXPECT_FALSE(camera->connect({0.1f, 0.2f, 0}, {0.5f, 0.5f}, 0));
    EXPECT_TRUE(camera->connect({0.1f, 0.2f, 1}, {0.5f, 0.5f}, 0));
    // A point outside the picture is not behind the camera.
    const auto beside = camera->connect({50, 0, 1}, {0.5f, 0.5f}, 0);
    ASSERT_TRUE(beside);
    EXPECT_GT(beside->film.x, kWidth);
  }
}

TEST(CameraConnect, MeasuredLensesDoNotConnect) {
  const auto camera = camera_of(
      "Camera \"realistic\" \"string lensfile\" \"lenses/thin.dat\" "
      "\"float focusdistance\" 1",
      8, 8);
  EXPECT_FALSE(camera->connects());
  EXPECT_FALSE(camera->connect({0, 0, 1}, {0.5f, 0.5f}, 0));
}

// Directions beyond the edges of a spherical picture also lie inside it: every film point outside
// repeats the inner point that sees the same.
TEST(CameraConnect, PicturesOfSpheresRepeat) {
  for (const std::string mapping : {"equirectangular", "equalarea"}) {
    const auto camera =
        camera_of("Camera \"spherical\" \"string mapping\" \"" + mapping + "\"", kWidth, kHeight);
    constexpr float kReach = 4;
    Random random;
    int outside = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec2f film(-kReach + random.next() * (kWidth + 2 * kReach),
                       -kReach + random.next() * (kHeight + 2 * kReach));
      const bool in = film.x >= 0 && film.x <= kWidth && film.y >= 0 && film.y <= kHeight;
      const Vec3f d = camera->generate_ray(film, {0.5f, 0.5f}, 0)->ray.d;
      const auto c = camera->connect(d, {0.5f, 0.5f}, 0);
      if (!c) continue;
      Vec2f out[3];
      int found = (c->film - film).length() < 5e-3f;
      EXPECT_EQ(found, in);
      for (int k = camera->repeats(c->film, out) - 1; k >= 0; --k) {
        expect_near(camera->generate_ray(out[k], {0.5f, 0.5f}, 0)->ray.d, d);
        found += (out[k] - film).length() < 5e-3f;
      }
      EXPECT_EQ(found, 1) << mapping << ' ' << film.x << ' ' << film.y;
      outside += !in;
    }
    EXPECT_GT(outside, 500);
  }
}

}  // namespace
}  // namespace nephroid
