// Moving objects against a still copy at the ray's time and against closed forms. Rays leave moving
// surfaces. Objects that cannot move give warnings.
#include "core/motion.h"

#include <gtest/gtest.h>

#include <bit>

#include "core/parallel.h"
#include "core/sampler.h"
#include "core/warps.h"
#include "input/pbrt_parser.h"
#include "input/transform_directives.h"
#include "scene/scene.h"
#include "unit/scene/numbers.h"

namespace nephroid {
namespace {

std::unique_ptr<Scene> scene_of(const std::string& world, Diagnostics& diagnostics,
                                const std::string& options = "") {
  const SceneDescription d =
      parse_pbrt_string(options + "\nWorldBegin\n" + world, "test.pbrt", ".", diagnostics);
  return build_scene(d, {}, diagnostics);
}
std::unique_ptr<Scene> scene_of(const std::string& world, const std::string& options = "") {
  Diagnostics diagnostics;
  return scene_of(world, diagnostics, options);
}

/// Transform directives that produce this matrix.
std::string text_of(const Mat44d& m) {
  std::string text = "ConcatTransform [";
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      char number[40];
      std::snprintf(number, sizeof number, " %.17g", m[i][j]);
      text += number;
    }
  return text + " ]\n";
}
std::string moving(const Mat44d& start, const Mat44d& end) {
  return "ActiveTransform StartTime " + text_of(start) + "ActiveTransform EndTime " + text_of(end) +
         "ActiveTransform All\n";
}

Mat44d turned(double degrees, const Vec3d& axis) {
  return *rotation_matrix(degrees, axis);
}
Mat44d moved(double x, double y, double z) {
  return translation_matrix({x, y, z});
}

constexpr char kMovingSphere[] = "Shape \"sphere\" \"float radius\" 1 \"float zmax\" 0.6\n";
constexpr char kMesh[] =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2  0 3 1  0 2 3  1 3 2]\n"
    "  \"point3 P\" [1 1 1  1 -1 -1  -1 1 -1  -1 -1 1]\n"
    "  \"point2 uv\" [0 0  1 0  1 1  0 1]\n";
constexpr char kPatch[] =
    "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 -0.5  1 -1 0.5  -1 1 0.5  1 1 -0.5]\n";

/// Shoots rays of all times at `moving` and at `still(time)`. Only silhouettes may differ, by
/// rounding.
template <class Still>
void expect_same_pictures(const Scene& scene, const Still& still, float size) {
  Numbers u{77};
  int met = 0, different = 0;
  for (int k = 0; k <= 16; ++k) {
    const float time = static_cast<float>(k) / 16.0f;
    const std::unique_ptr<Scene> oracle = still(time);
    for (int i = 0; i < 1500; ++i) {
      Ray ray;
      ray.o = u.in_cube(3 * size);
      ray.d = u.in_cube(size) - ray.o;
      ray.time = time;
      SurfaceInteraction a, b;
      const bool hit = scene.intersect(ray, a);
      const bool expected = oracle->intersect(ray, b);
      met += expected;
      SampledWavelengths lambda = SampledWavelengths::sample_visible(0.5f);
      EXPECT_EQ(hit, scene.transmittance(ray, lambda)[0] == 0.0f);
      if (hit != expected) {
        ++different;
        continue;
      }
      if (!hit) continue;
      if (std::abs(a.distance - b.distance) > 1e-4f * size) {
        ++different;
        continue;
      }
      EXPECT_EQ(a.time, time);
      EXPECT_LT(length(a.p - b.p), 1e-4f * size);
      for (int j = 0; j < 2; ++j) {
        const float apart = std::abs(a.uv[j] - b.uv[j]);
        EXPECT_LT(std::min(apart, 1 - apart), 2e-2f);  // angles wrap around
      }
      // Near round silhouettes a small step turns the normal further.
      EXPECT_LT(length(a.ng - b.ng), 2e-2f) << "at " << time;
      EXPECT_LT(length(a.shading.z - b.shading.z), 2e-2f) << "at " << time;
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_LE(different, 5);
}

struct Motion {
  Mat44d start, end;
};
const Motion kMotions[] = {
    {moved(-2, 0, 0), moved(2, 1, 0)},
    {turned(20, {1, 1, 0}) * moved(-1, 0, 0), turned(170, {0, 0, 1}) * moved(1, 1, 0)},
    {scale_matrix({1, 0.5, 2}), turned(170, {1, 2, 3}) * moved(0, 0, 2)},
};

TEST(MotionBlur, MovingShapesAreWhereTheyBelong) {
  for (const char* shape : {kMovingSphere, kMesh, kPatch})
    for (const Motion& m : kMotions) {
      const auto scene = scene_of(moving(m.start, m.end) + shape);
      const MotionTransform motion(m.start, m.end);
      expect_same_pictures(
          *scene, [&](float time) { return scene_of(text_of(motion.at(time).m) + shape); }, 2);
    }
}

// The instance's coordinate system rotates about the camera, as in pbrt-v4, or about the world
// origin if requested.
TEST(MotionBlur, MovingInstancesTurnAboutTheOriginOfTheRenderingSpace) {
  const std::string object =
      std::string("ObjectBegin \"o\" Translate 0.2 0 0 ") + kMovingSphere + kMesh + "ObjectEnd\n";
  const std::string camera =
      "LookAt 1 2 -3  0 0 0  0 1 0 ActiveTransform EndTime Translate 0.5 0 0\n"
      "Camera \"perspective\"\n";
  // From world space, the camera's translation acts before its look-at matrix.
  const Vec3d pivot(0.75, 2, -3);
  for (const std::string space : {"", "camera", "cameraworld", "world"})
    for (const Motion& m : kMotions) {
      const std::string option =
          space.empty() ? "" : "Option \"string rendercoordsys\" \"" + space + "\"\n";
      const auto scene =
          scene_of(object + moving(m.start, m.end) + "ObjectInstance \"o\"", option + camera);
      const MotionTransform motion(m.start, m.end, space == "world" ? Vec3d(0, 0, 0) : pivot);
      expect_same_pictures(
          *scene,
          [&](float time) {
            return scene_of(object + text_of(motion.at(time).m) + "ObjectInstance \"o\"", camera);
          },
          2);
    }
}

TEST(MotionBlur, MovingShapesInMovingInstances) {
  const Motion& inner = kMotions[1];
  const Motion outer = {turned(-40, {0, 1, 0}), turned(90, {0, 1, 1}) * moved(0, 0.5, -1)};
  for (const bool outer_moves : {true, false}) {
    const auto object = [&](const std::string& transform) {
      return std::string("ObjectBegin \"o\" ") + kMesh + "AttributeBegin " + transform +
             kMovingSphere + "AttributeEnd Translate 0 0 2 " + kPatch + "ObjectEnd\n";
    };
    const Mat44d end = outer_moves ? outer.end : outer.start;
    const auto scene = scene_of(object(moving(inner.start, inner.end)) + "Translate 0 0.25 0 " +
                                kMovingSphere + moving(outer.start, end) +
                                "ObjectInstance \"o\" Translate 3 0 0 ObjectInstance \"o\"");
    EXPECT_EQ(scene->instance_count, 2u);
    EXPECT_EQ(scene->groups.size(), 1u);
    const MotionTransform inside(inner.start, inner.end);
    const MotionTransform first(outer.start * moved(0, 0.25, 0), end * moved(0, 0.25, 0));
    const MotionTransform second(moved(3, 0, 0) * outer.start * moved(0, 0.25, 0),
                                 moved(3, 0, 0) * end * moved(0, 0.25, 0));
    expect_same_pictures(
        *scene,
        [&](float time) {
          return scene_of(object(text_of(inside.at(time).m)) +
                          "AttributeBegin Translate 0 0.25 0 " + kMovingSphere + "AttributeEnd " +
                          "AttributeBegin " + text_of(first.at(time).m) +
                          "ObjectInstance \"o\" AttributeEnd " + text_of(second.at(time).m) +
                          "ObjectInstance \"o\"");
        },
        3);
  }
}

// A sphere of radius 1 that moves from x = -3 to 3. A ray along z at (x, y) hits it while its
// centre is within sqrt(1 - y^2) of x.
TEST(MotionBlur, AFlyingSphereCoversARayForItsShareOfTheShutter) {
  const auto scene =
      scene_of(moving(moved(-3, 0, 0), moved(3, 0, 0)) + "Shape \"sphere\" \"float radius\" 1");
  constexpr int kTimes = 1000;
  for (const float x : {-3.5f, -1.0f, 0.0f, 0.7f, 2.6f})
    for (const float y : {0.0f, 0.5f, 0.99f, 1.01f}) {
      const double half = std::sqrt(std::max(0.0, 1 - double(y) * y));
      const double from = std::max(-3.0, x - half), to = std::min(3.0, x + half);
      int met = 0;
      for (int i = 0; i < kTimes; ++i) {
        Ray ray;
        ray.o = {x, y, -5};
        ray.d = {0, 0, 1};
        ray.time = (static_cast<float>(i) + 0.5f) / kTimes;
        SurfaceInteraction hit;
        if (!scene->intersect(ray, hit)) continue;
        ++met;
        // The normal points away from the current centre.
        const Vec3f centre(6 * ray.time - 3, 0, 0);
        EXPECT_LT(length(hit.p - centre - hit.ng), 1e-5f);
      }
      EXPECT_NEAR(met, kTimes * std::max(0.0, to - from) / 6, 1.01) << x << ' ' << y;
    }
}

// A wheel of six spokes that turns by 170 degrees about z. At radius r a ray hits spokes of half
// width w for the share of angles that they sweep over it.
TEST(MotionBlur, AWheelCoversARayByTheAnglesOfItsSpokes) {
  std::string spokes;
  for (int i = 0; i < 6; ++i)
    spokes +=
        "Shape \"trianglemesh\" \"point3 P\" [0 -0.1 0  2 -0.1 0  2 0.1 0  0 0.1 0]"
        "\"integer indices\" [0 1 2 0 2 3] Rotate 60 0 0 1\n";
  const auto scene =
      scene_of("ObjectBegin \"wheel\" " + spokes + "ObjectEnd\n" +
               moving(Mat44d(), turned(170, {0, 0, 1})) + "ObjectInstance \"wheel\"");
  constexpr int kTimes = 2000;
  for (const float r : {0.3f, 1.0f, 1.9f})
    for (const float degrees : {5.0f, 30.0f, 77.0f, 200.0f}) {
      const double half = std::asin(0.1 / double(r)) * 180 / kPi;
      double swept = 0;
      for (int spoke = -4; spoke < 8; ++spoke) {
        // In the wheel's frame the ray moves from `degrees` down to `degrees` - 170.
        const double low = std::max(60.0 * spoke - half, double(degrees) - 170);
        const double high = std::min(60.0 * spoke + half, double(degrees));
        swept += std::max(0.0, high - low);
      }
      int met = 0;
      for (int i = 0; i < kTimes; ++i) {
        Ray ray;
        ray.o = {r * std::cos(degrees * kPi / 180), r * std::sin(degrees * kPi / 180), -4};
        ray.d = {0, 0, 1};
        ray.time = (static_cast<float>(i) + 0.5f) / kTimes;
        SurfaceInteraction hit;
        met += scene->intersect(ray, hit);
      }
      EXPECT_NEAR(met, kTimes * swept / 170, 4) << r << ' ' << degrees;
    }
  const Bounds3f bounds = scene->top.accelerator->bounds();
  EXPECT_GE(bounds.max.y, 2.0f);
  EXPECT_LT(bounds.max.y, 3.0f);  // a corner of the box sweeps an arc
}

// Passes through a singular matrix to the mirrored object: at that moment it vanishes, and nothing
// breaks.
TEST(MotionBlur, AMotionThroughAFlatPictureIsTraced) {
  const auto scene = scene_of(moving(Mat44d(), scale_matrix({-1, 1, 1})) + kMesh);
  Numbers u{5};
  for (int i = 0; i < 2000; ++i) {
    Ray ray;
    ray.o = u.in_cube(3);
    ray.d = u.in_cube(1) - ray.o;
    ray.time = i % 3 ? u() : 0.5f + static_cast<float>(i % 7 - 3) * 1e-8f;
    SurfaceInteraction hit;
    if (scene->intersect(ray, hit)) {
      EXPECT_TRUE(is_finite(hit.p));
    }
  }
}

TEST(MotionBlur, ManyThreadsSeeTheSameBits) {
  std::string world = std::string("ObjectBegin \"o\" ") + moving(Mat44d(), moved(0.3, 0, 0)) +
                      kMesh + "ObjectEnd\n";
  for (int i = 0; i < 12; ++i)
    world += "AttributeBegin " +
             moving(moved(i - 6, 0, 0), turned(20 * i, {1, 1, 1}) * moved(i - 6, 1, 0)) +
             "ObjectInstance \"o\" AttributeEnd\n";
  const auto scene = scene_of(world);
  const auto trace = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<uint32_t> bits(20000);
    parallel_chunks(static_cast<int64_t>(bits.size()), 64,
                    [&](int64_t, int64_t begin, int64_t end) {
                      for (int64_t i = begin; i < end; ++i) {
                        Numbers u{static_cast<uint64_t>(i) * 1000};
                        Ray ray;
                        ray.o = u.in_cube(8);
                        ray.d = u.in_cube(3) - ray.o;
                        ray.time = u();
                        SurfaceInteraction hit;
                        if (scene->intersect(ray, hit))
                          bits[static_cast<size_t>(i)] =
                              std::bit_cast<uint32_t>(hit.p.x) ^ (hit.primitive << 20);
                      }
                    });
    return bits;
  };
  const std::vector<uint32_t> one = trace(1);
  EXPECT_GT(std::count_if(one.begin(), one.end(), [](uint32_t b) { return b != 0; }), 2000);
  EXPECT_EQ(one, trace(4));
}

// Rays that leave a flat moving surface never hit it again, at any time.
TEST(MotionBlur, RaysNeverMeetTheMovingSurfaceTheyLeave) {
  const std::string plane =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
      "[-1 0.1 -1  -1 0.1 1  1 0.1 1  1 0.1 -1]\n";
  const std::string patch =
      "Shape \"bilinearmesh\" \"point3 P\" [-1 0.1 -1  1 0.1 -1  -1 0.1 1  1 0.1 1]\n";
  for (const std::string& shape : {plane, patch})
    for (const double size : {1e-4, 1.0, 1e4})
      for (const bool nested : {false, true}) {
        const Mat44d grow = scale_matrix(Vec3d(size, size, size));
        const std::string motion = moving(turned(10, {1, 2, 3}) * moved(0, 7, 0) * grow,
                                          turned(160, {1, 0, 3}) * moved(3, -5, 2) * grow);
        const auto scene =
            scene_of(nested ? "ObjectBegin \"o\" " +
                                  moving(Mat44d(), turned(80, {0, 1, 0}) * moved(0, 1, 0)) + shape +
                                  "ObjectEnd " + motion + "ObjectInstance \"o\""
                            : motion + shape);
        Numbers u{99};
        int landed = 0, again = 0;
        for (int i = 0; i < 40000; ++i) {
          Ray ray;
          const float s = static_cast<float>(size);
          ray.time = u();
          // Aim at a point of the moving object.
          const MotionTransform outer(turned(10, {1, 2, 3}) * moved(0, 7, 0) * grow,
                                      turned(160, {1, 0, 3}) * moved(3, -5, 2) * grow);
          const Vec3f target = outer.at(ray.time).point(Vec3f(u() - 0.5f, 0.1f, u() - 0.5f));
          ray.o = target + u.in_cube(2 * s);
          ray.d = normalize(target - ray.o);
          SurfaceInteraction hit, other;
          if (!scene->intersect(ray, hit)) continue;
          ++landed;
          Vec3f w = square_to_cosine_hemisphere({u(), u()});
          if (i % 3 == 0) w = normalize(Vec3f(w.x, w.y, w.z * 1e-3f));
          Ray away;
          away.d = Frame::from_z(hit.ng).to_world(i % 2 ? w : -w);
          away.o = hit.spawn_origin(away.d);
          away.time = hit.time;
          again += scene->intersect(away, other);
        }
        EXPECT_GT(landed, nested ? 2000 : 20000);
        EXPECT_EQ(again, 0) << size << (nested ? " nested" : "");
      }
}

TEST(MotionBlur, WhatCannotMoveSaysSo) {
  Diagnostics diagnostics;
  const auto scene = scene_of(
      "AreaLightSource \"diffuse\"\n" + moving(moved(5, 0, 0), moved(9, 0, 0)) + kMovingSphere,
      diagnostics);
  ASSERT_EQ(scene->lights.size(), 1u);
  EXPECT_TRUE(scene->top.instances.empty());
  int told = 0;
  for (const Warning& warning : diagnostics.warnings())
    if (warning.message.find("cannot move") != std::string::npos && warning.where.line == 7) ++told;
  EXPECT_EQ(told, 1);
  EXPECT_NEAR(scene->top.accelerator->bounds().min.x, 4, 1e-4);

  EXPECT_THROW(scene_of(moving(Mat44d(), moved(1e18, 0, 0)) + kMovingSphere), SceneError);
  EXPECT_THROW(scene_of(kMovingSphere, "Option \"string rendercoordsys\" \"moon\"\n"), SceneError);
}

}  // namespace
}  // namespace nephroid
