// What a survey finds out about which lights of a scene reach which places.
#include "transport/light_survey.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "input/pbrt_parser.h"

namespace nephroid {
namespace {

/// Two rooms with a floor each and a lamp each, seen from above through their open ceilings, and a
/// wall between them. `things` come before the wall.
std::string two_rooms(const std::string& things = "") {
  return R"(
    LookAt 0 6 0  0 0 0  0 0 1 Camera "perspective" "float fov" 60
    Film "rgb" "integer xresolution" 48 "integer yresolution" 48
    WorldBegin)" +
         things + R"(
    LightSource "point" "point3 from" [-1 1 0]
    LightSource "point" "point3 from" [1 1 0]
    Material "diffuse"
    Shape "bilinearmesh" "point3 P" [-2 0 -2  2 0 -2  -2 0 2  2 0 2]
    Shape "bilinearmesh" "point3 P" [0 0 -2  0 2 -2  0 0 2  0 2 2]
  )";
}

SceneDescription description_of(const std::string& text) {
  Diagnostics diagnostics;
  return parse_pbrt_string(text, "test.pbrt", ".", diagnostics);
}

std::unique_ptr<Scene> surveyed(const std::string& text, const SceneOverrides& overrides = {}) {
  Diagnostics diagnostics;
  auto scene = build_scene(description_of(text), overrides, diagnostics);
  scene->light_sampler->learn(survey_lights(*scene));
  return scene;
}

float chance_of(const Scene& scene, int light, const Vec3f& p) {
  return scene.light_sampler->pmf(p, {0, 1, 0}, light);
}

TEST(LightSurvey, FindsOutWhichLampShinesInWhichRoom) {
  const auto scene = surveyed(two_rooms());
  EXPECT_GT(chance_of(*scene, 0, {-0.3f, 0, 0.5f}), 0.8f);
  EXPECT_GT(chance_of(*scene, 1, {0.3f, 0, -0.5f}), 0.8f);
  EXPECT_GT(chance_of(*scene, 0, {0.3f, 0, -0.5f}), 0.0f);
}

TEST(LightSurvey, SeesThroughGlass) {
  const auto scene = surveyed(two_rooms(R"(
    AttributeBegin Material "dielectric"
      Shape "bilinearmesh" "point3 P" [-3 4 -3  3 4 -3  -3 4 3  3 4 3] AttributeEnd)"));
  EXPECT_GT(chance_of(*scene, 0, {-0.3f, 0, 0.5f}), 0.8f);
  EXPECT_GT(chance_of(*scene, 1, {0.3f, 0, -0.5f}), 0.8f);
}

TEST(LightSurvey, SeesInMirrors) {
  // The camera looks up, into a mirror.
  std::string text = two_rooms(R"(
    AttributeBegin Material "conductor" "float roughness" 0
      Shape "bilinearmesh" "point3 P" [-9 6.5 -9  9 6.5 -9  -9 6.5 9  9 6.5 9] AttributeEnd)");
  const std::string from = "LookAt 0 6 0  0 0 0  0 0 1";
  text.replace(text.find(from), from.size(), "LookAt 0 6 0  0 9 0  0 0 1");
  const auto scene = surveyed(text);
  EXPECT_GT(chance_of(*scene, 0, {-0.3f, 0, 0.5f}), 0.8f);
  EXPECT_GT(chance_of(*scene, 1, {0.3f, 0, -0.5f}), 0.8f);
}

TEST(LightSurvey, TellsASkyFromALamp) {
  // The lamp is brighter, but hangs below the floor.
  const auto scene = surveyed(two_rooms(R"(
    LightSource "infinite"
    LightSource "point" "rgb I" [1e4 1e4 1e4] "point3 from" [0 -1 0])"));
  EXPECT_LT(chance_of(*scene, 1, {0.5f, 0, 0}), 0.1f);
}

/// Chances of a lamp along the floor.
std::vector<float> chances(const Scene& scene) {
  std::vector<float> all;
  for (float x = -1.9f; x < 2; x += 0.1f)
    for (float z = -1.9f; z < 2; z += 0.1f) all.push_back(chance_of(scene, 0, {x, 0, z}));
  return all;
}

TEST(LightSurvey, IsTheSameForAnyNumberOfThreads) {
  const auto with = [](int threads) {
    const ThreadLimit limit(threads);
    return chances(*surveyed(two_rooms()));
  };
  EXPECT_EQ(with(1), with(3));
}

TEST(LightSurvey, IsTheSameForAPartOfThePicture) {
  SceneOverrides part;
  part.has_crop = true;
  part.crop[1] = 0.3f;
  EXPECT_EQ(chances(*surveyed(two_rooms())), chances(*surveyed(two_rooms(), part)));
}

TEST(LightSurvey, SurvivesLightsWithoutMeasure) {
  const auto scene = surveyed(two_rooms(R"(
    LightSource "infinite" "float scale" 1e25
    LightSource "infinite" "float scale" 1e-25)"));
  for (int light = 0; light < 4; ++light) {
    const float chance = chance_of(*scene, light, {0.5f, 0, 0});
    EXPECT_TRUE(chance > 0 && chance <= 1) << chance;
  }
}

TEST(LightSurvey, OfACameraThatSeesNothingChangesNothing) {
  std::string text = two_rooms();
  const std::string from = "LookAt 0 6 0  0 0 0  0 0 1";
  text.replace(text.find(from), from.size(), "LookAt 0 6 0  0 9 0  0 0 1");
  const auto scene = surveyed(text);
  EXPECT_EQ(chance_of(*scene, 0, {0.5f, 0, 0.2f}),
            scene->light_sampler->plain_pmf({0.5f, 0, 0.2f}, {0, 1, 0}, 0));
}

TEST(LightSurvey, HasNothingToDoForOneLamp) {
  EXPECT_TRUE(survey_lights(*surveyed(R"(WorldBegin LightSource "point" Shape "sphere")")).empty());
  EXPECT_TRUE(survey_lights(*surveyed(R"(WorldBegin Shape "sphere")")).empty());
}

}  // namespace
}  // namespace nephroid
