// Camera, light, floor, sky and exposure of scenes that lack them.
#include "input/staging/staging.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/color.h"
#include "input/staging/default_view.h"
#include "unit/input/parse_text.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::parse;

constexpr const char* kBox =
    "WorldBegin\nAttributeBegin\nTranslate 5 1 0\nShape \"sphere\" \"float radius\" 2\n"
    "AttributeEnd\nObjectBegin \"o\"\nShape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 "
    "0]\n"
    "ObjectEnd\nTranslate 0 0 9\nObjectInstance \"o\"\n";

SceneDescription staged(const std::string& text, const ImportOptions& options = {},
                        bool is_complete = false) {
  SceneDescription scene = parse(text);
  Diagnostics diagnostics;
  stage_scene(&scene, {.is_complete = is_complete, .has_exposure = true}, options, diagnostics);
  return scene;
}

Bounds3d bounds_of(const std::string& text) {
  return scene_extent(parse(text), {}).bounds;
}

Vec3d in_camera(const SceneDescription& scene, const Vec3d& p) {
  return p * scene.camera->world_to_camera.start;
}

TEST(SceneBounds, AreThoseOfShapesAndInstances) {
  const Bounds3d bounds = bounds_of(kBox);
  EXPECT_EQ(bounds.min, Vec3d(0, -1, -2));
  EXPECT_EQ(bounds.max, Vec3d(7, 3, 9));
  EXPECT_TRUE(bounds_of("WorldBegin\n").isEmpty());
}

TEST(SceneBounds, KnowAllQuadricsAndTheirMotion) {
  const auto of = [](const std::string& shape) { return bounds_of("WorldBegin\n" + shape); };
  EXPECT_EQ(of("Shape \"disk\" \"float radius\" 3 \"float height\" 2").min, Vec3d(-3, -3, 2));
  EXPECT_EQ(of("Shape \"cylinder\" \"float zmax\" 4").max, Vec3d(1, 1, 4));
  EXPECT_EQ(of("Shape \"sphere\" \"float zmin\" 0").min, Vec3d(-1, -1, 0));
  EXPECT_EQ(of("Shape \"curve\" \"point3 P\" [0 0 0 0 0 1 0 0 2 0 0 3] \"float width\" 2").max,
            Vec3d(1, 1, 4));
  EXPECT_EQ(
      of("ActiveTransform EndTime\nTranslate 5 0 0\nActiveTransform All\nShape \"sphere\"").max,
      Vec3d(6, 1, 1));
}

TEST(DefaultView, ShowsAllOfTheSceneAndFillsTheFrame) {
  const SceneDescription scene = staged(kBox);
  ASSERT_TRUE(scene.camera);
  const double slope = std::tan(scene.camera->parameters.get_float("fov", 0) / 2 * kPi / 180);
  double left = 0, right = 0, top = 0, bottom = 0;
  for (const double x : {0.0, 7.0})
    for (const double y : {-1.0, 3.0})
      for (const double z : {-2.0, 9.0}) {
        const Vec3d p = in_camera(scene, {x, y, z});
        ASSERT_GT(p.z, 0);
        left = std::min(left, p.x / p.z);
        right = std::max(right, p.x / p.z);
        bottom = std::min(bottom, p.y / p.z);
        top = std::max(top, p.y / p.z);
      }
  // The box of the sphere and that of the instance fill a part of this box only.
  EXPECT_LT(std::max({-left, right, -bottom, top}), 1.3 * slope);
  EXPECT_GT(std::max({-left, right, -bottom, top}), 0.85 * slope);
  // From the front right and above: the right of the scene is nearer, and up is up.
  EXPECT_LT(in_camera(scene, {7, 1, 9}).z, in_camera(scene, {0, 1, -2}).z);
  EXPECT_GT(in_camera(scene, {7, 3, 9}).y, in_camera(scene, {7, -1, 9}).y);
  EXPECT_GT(in_camera(scene, {7, 1, 3}).x, in_camera(scene, {0, 1, 3}).x);
}

TEST(DefaultView, HoldsThePointsOfAMeshTightly) {
  const std::string points = "-3 0 1 4 0.5 0 0 2 -5 1 1 1";
  const SceneDescription scene = staged("WorldBegin\nShape \"trianglemesh\" \"point3 P\" [" +
                                        points + "] \"integer indices\" [0 1 2 1 2 3]\n");
  const double slope = std::tan(scene.camera->parameters.get_float("fov", 0) / 2 * kPi / 180);
  double left = 0, right = 0, height = 0;
  for (const Vec3d& p : {Vec3d(-3, 0, 1), Vec3d(4, 0.5, 0), Vec3d(0, 2, -5), Vec3d(1, 1, 1)}) {
    const Vec3d c = in_camera(scene, p);
    ASSERT_GT(c.z, 0);
    left = std::min(left, c.x / c.z);
    right = std::max(right, c.x / c.z);
    height = std::max(height, std::abs(c.y / c.z));
  }
  EXPECT_LT(std::max({-left, right, height}), slope);
  EXPECT_GT(std::max(-left, right), 0.85 * slope);
  EXPECT_NEAR(-left, right, 0.1 * slope);  // in the middle
}

TEST(DefaultView, LightsAWhiteSurfaceToOne) {
  const SceneDescription scene = staged(kBox);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, "infinite");
  const ShapeDescription& key = scene.shapes.back();
  ASSERT_TRUE(key.area_light);
  // Illuminance over pi of a surface at the centre that faces the lamp, whose sky is not blocked.
  const Vec3d centre(3.5, 1, 3.5);
  const Vec3d lamp = Vec3d(0, 0, 0) * key.transform.start;
  Vec3d normal;
  key.transform.start.multDirMatrix(Vec3d(0, 0, 1), normal);
  EXPECT_NEAR(normal.dot((centre - lamp).normalized()), 1, 1e-12);
  const double radius = key.parameters.get_float("radius", 0);
  const double distance2 = (lamp - centre).dot(lamp - centre);
  const double sine2 = radius * radius / (radius * radius + distance2);
  const double value = scene.lights[0].parameters.find("L")->numbers[0] +
                       key.area_light->parameters.find("L")->numbers[0] * sine2;
  EXPECT_NEAR(value, 1, 1e-6);
  EXPECT_GT(lamp.y, 3);
}

TEST(DefaultView, RespectsWhatTheFileHas) {
  const std::string lit =
      std::string("Camera \"orthographic\"\n") + kBox + "LightSource \"point\"\n";
  const SceneDescription scene = staged(lit);
  EXPECT_EQ(scene.camera->type, "orthographic");
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.shapes.size(), 1u);
  // A pbrt-v4 scene is as its author wants it.
  const SceneDescription dark = staged(kBox, {}, true);
  EXPECT_FALSE(dark.camera);
  EXPECT_TRUE(dark.lights.empty());
}

TEST(DefaultView, NeedsShapes) {
  EXPECT_NE(error_of([] { staged("WorldBegin\n"); }).find("the scene has no shapes"),
            std::string::npos);
}

TEST(Floor, LiesJustUnderTheLowestPointAlongTheCamerasUp) {
  ImportOptions options;
  options.floor = true;
  const auto floor_of = [&](const std::string& camera) {
    const ShapeDescription floor = staged(camera + kBox, options, true).shapes.back();
    EXPECT_EQ(floor.type, "disk");
    EXPECT_GT(floor.parameters.get_float("radius", 0), 100);
    return floor.transform.start;
  };
  const double gap = 0.01;
  const Vec3d y_up = Vec3d(0, 0, 0) * floor_of("");
  EXPECT_LT(y_up.y, -1);
  EXPECT_GT(y_up.y, -1 - gap);
  const Mat44d z_up = floor_of("LookAt 9 9 9 0 0 0 0 0 1\nCamera \"perspective\"\n");
  const Vec3d centre = Vec3d(0, 0, 0) * z_up;
  EXPECT_LT(centre.z, -2);
  EXPECT_GT(centre.z, -2 - gap);
  Vec3d normal;
  z_up.multDirMatrix(Vec3d(0, 0, 1), normal);
  EXPECT_NEAR(normal.z, 1, 1e-12);
}

TEST(Surroundings, AreRightHandedForEveryUp) {
  for (const char* up : {"1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1"}) {
    const Surroundings s = surroundings_of(
        parse(std::string("LookAt 3 4 5 0 0 0 ") + up + "\nCamera \"perspective\"\nWorldBegin\n"));
    EXPECT_EQ(s.east.cross(s.north), s.up) << up;
    EXPECT_EQ(s.up.dot(s.east), 0) << up;
  }
}

TEST(Surroundings, AreThoseOfLookAtHoweverSteepTheCamera) {
  const auto up_of = [](const std::string& camera) {
    return surroundings_of(parse(camera + "\nCamera \"perspective\"\nWorldBegin\n")).up;
  };
  EXPECT_EQ(up_of("LookAt 0 12 10 0 0 0 0 1 0"), Vec3d(0, 1, 0));
  EXPECT_EQ(up_of("LookAt 0 12 1 0 0 0 0 1 0"), Vec3d(0, 1, 0));
  EXPECT_EQ(up_of("LookAt 3 1 -12 0 0 0 0 0 -1"), Vec3d(0, 0, -1));
  EXPECT_EQ(up_of("Rotate 20 0 0 1 Scale -1 1 1 LookAt 0 12 10 0 0 0 0 1 0"), Vec3d(0, 1, 0));
  // A Rotate after LookAt turns the world.
  EXPECT_EQ(up_of("LookAt 0 12 10 0 0 0 0 1 0 Rotate 90 1 0 0"), Vec3d(0, 0, -1));
  // Only the camera of the start counts.
  EXPECT_EQ(up_of("LookAt 0 12 10 0 0 0 0 1 0 ActiveTransform EndTime LookAt 0 12 10 0 0 0 1 0 0 "
                  "Transform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1] ActiveTransform All"),
            Vec3d(0, 1, 0));
  // A matrix has no up but the camera's own.
  EXPECT_EQ(up_of("LookAt 0 12 10 0 0 0 0 1 0 Identity"), Vec3d(0, 1, 0));
  EXPECT_EQ(up_of("Rotate -60 1 0 0"), Vec3d(0, 0, 1));
}

TEST(Exposure, CountsStopsOverTheScenes) {
  ImportOptions options;
  options.exposure = 2;
  const auto iso = [&](const std::string& film) {
    return staged(film + kBox, options, true).film->parameters.get_float("iso", 100);
  };
  EXPECT_EQ(iso(""), 400);
  EXPECT_EQ(iso("Film \"rgb\" \"float iso\" 50\n"), 200);
}

TEST(Sun, ReplacesLightsAtInfinityAndKeepsLamps) {
  ImportOptions options;
  options.sun = SunDirection{30, 90};
  const SceneDescription scene = staged(std::string(kBox) +
                                            "LightSource \"distant\"\nLightSource \"infinite\"\n"
                                            "LightSource \"point\"\n",
                                        options, true);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].type, "point");
  EXPECT_EQ(scene.lights[1].type, "infinite");
  EXPECT_EQ(scene.lights[2].type, "distant");
  // From the east, a third of a quarter turn above the horizon.
  Vec3d to_sun;
  scene.lights[2].transform.start.multDirMatrix(
      Vec3d(*scene.lights[2].parameters.get_point3("from")), to_sun);
  EXPECT_NEAR(to_sun.x, std::sqrt(0.75), 1e-6);
  EXPECT_NEAR(to_sun.y, 0.5, 1e-6);
  EXPECT_NEAR(to_sun.z, 0, 1e-6);
  EXPECT_TRUE(scene.files->in_memory("--sun#/sky.pfm"));
  // A white surface that faces the sun has a value near 1, by sun and sky.
  const std::vector<double> l = scene.lights[2].parameters.find("L")->numbers;
  const double illuminance =
      RgbColorSpace::srgb()
          .to_xyz({static_cast<float>(l[0]), static_cast<float>(l[1]), static_cast<float>(l[2])})
          .y;
  const double value = scene.film->parameters.get_float("iso", 100) / 100 * illuminance / kPi;
  EXPECT_GT(value, 0.7);
  EXPECT_LT(value, 1);
}

TEST(Environment, IsTheOnlyInfiniteLight) {
  ImportOptions options;
  options.environment = "sky.exr";
  const SceneDescription alone = staged(kBox, options);
  ASSERT_EQ(alone.lights.size(), 1u);
  EXPECT_EQ(alone.shapes.size(), 1u);  // no lamp
  EXPECT_TRUE(alone.lights[0].parameters.find("illuminance"));
  Vec3d up;
  alone.lights[0].transform.start.multDirMatrix(Vec3d(0, 0, 1), up);
  EXPECT_EQ(up, Vec3d(0, 1, 0));
  // Beside a lamp its values count.
  const SceneDescription beside =
      staged(std::string(kBox) + "LightSource \"infinite\"\nLightSource \"point\"\n", options);
  ASSERT_EQ(beside.lights.size(), 2u);
  EXPECT_FALSE(beside.lights[1].parameters.find("illuminance"));
}

TEST(Sun, IsAsBrightAsDaylight) {
  const auto sun_light = [](double elevation) {
    ImportOptions options;
    options.sun = SunDirection{elevation, 0};
    const SceneDescription scene = staged(kBox, options);
    const std::vector<double> l = scene.lights.at(1).parameters.find("L")->numbers;
    return Rgb{static_cast<float>(l[0]), static_cast<float>(l[1]), static_cast<float>(l[2])};
  };
  const auto illuminance = [&](double elevation) {
    return RgbColorSpace::srgb().to_xyz(sun_light(elevation)).y;
  };
  // Clear air passes about 100 klx at the zenith (IES Lighting Handbook), less through more of it.
  EXPECT_NEAR(illuminance(90), 100000, 15000);
  double last = 1e9;
  for (const double elevation : {90, 60, 30, 10, 3, 0}) {
    EXPECT_LT(illuminance(elevation), last);
    EXPECT_GT(illuminance(elevation), 0);
    last = illuminance(elevation);
  }
  EXPECT_GT(sun_light(5).r / sun_light(5).b, 3 * sun_light(90).r / sun_light(90).b);
}

}  // namespace
}  // namespace nephroid
