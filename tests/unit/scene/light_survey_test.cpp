// What a built scene knows about which of its lights reach which places.
#include "scene/light_survey.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "input/pbrt_parser.h"
#include "scene/scene_view.h"

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

std::unique_ptr<Scene> surveyed(const std::string& text) {
  Diagnostics diagnostics;
  return build_scene(description_of(text), {}, diagnostics);
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

TEST(LightSurvey, SeesThroughGlassAndInMirrors) {
  const auto scene = surveyed(two_rooms(R"(
    AttributeBegin Material "dielectric"
      Shape "bilinearmesh" "point3 P" [-3 4 -3  3 4 -3  -3 4 3  3 4 3] AttributeEnd)"));
  EXPECT_GT(chance_of(*scene, 0, {-0.3f, 0, 0.5f}), 0.8f);
  EXPECT_GT(chance_of(*scene, 1, {0.3f, 0, -0.5f}), 0.8f);
}

TEST(LightSurvey, TellsASkyFromALamp) {
  // The lamp is brighter, but hangs below a lid.
  const auto scene = surveyed(two_rooms(R"(
    LightSource "infinite"
    LightSource "point" "rgb I" [1e4 1e4 1e4] "point3 from" [0 -1 0])"));
  EXPECT_LT(chance_of(*scene, 1, {0.5f, 0, 0}), 0.1f);
}

TEST(LightSurvey, IsTheSameForAnyNumberOfThreads) {
  const auto one = [] {
    const ThreadLimit limit(1);
    return surveyed(two_rooms());
  }();
  const ThreadLimit limit(3);
  const auto three = surveyed(two_rooms());
  for (float x = -1.9f; x < 2; x += 0.1f)
    EXPECT_EQ(chance_of(*one, 0, {x, 0, 0.2f}), chance_of(*three, 0, {x, 0, 0.2f}));
}

// A view of a scene that was built with another camera renders the bits of a fresh start.
TEST(LightSurvey, FollowsTheCamera) {
  std::string moved = two_rooms();
  const std::string from = "LookAt 0 6 0  0 0 0  0 0 1";
  moved.replace(moved.find(from), from.size(), "LookAt 1 3 0  1 0 0  0 0 1");
  const auto fresh = surveyed(moved), renewed = surveyed(two_rooms());
  Diagnostics diagnostics;
  renew_camera(*renewed, description_of(moved), {}, diagnostics);
  for (float x = -1.9f; x < 2; x += 0.1f)
    EXPECT_EQ(chance_of(*fresh, 0, {x, 0, 0.2f}), chance_of(*renewed, 0, {x, 0, 0.2f}));
}

TEST(LightSurvey, HasNothingToDoForOneLamp) {
  EXPECT_TRUE(survey_lights(*surveyed(R"(WorldBegin LightSource "point" Shape "sphere")")).empty());
  EXPECT_TRUE(survey_lights(*surveyed(R"(WorldBegin Shape "sphere")")).empty());
}

}  // namespace
}  // namespace nephroid
