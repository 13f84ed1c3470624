// Option "keepcamera": a scene includes another one and gives it its own camera and film.
#include <gtest/gtest.h>

#include "input/convert/pbrt_writer.h"
#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::parse;
using testing::parse_warnings;
using testing::TemporaryDirectory;

constexpr const char* kOwn = R"(
  LookAt 1 2 3  0 0 0  0 1 0 Camera "orthographic" "float lensradius" 2
  Film "rgb" "integer xresolution" 7
  Identity
)";
constexpr const char* kIncluded = R"(
  TransformTimes 0 2
  Translate 4 5 6 Camera "perspective" "float fov" 30
  ColorSpace "rec2020" Film "gbuffer" "integer xresolution" 100
  MakeNamedMedium "fog" "string type" "homogeneous"
  WorldBegin
  CoordSysTransform "camera" LightSource "point"
)";

std::string kept(const std::string& value = "true") {
  return "Option \"bool keepcamera\" " + value + kOwn + kIncluded;
}

TEST(KeepCamera, TheFirstCameraAndFilmCount) {
  const SceneDescription scene = parse(kept());
  EXPECT_EQ(scene.camera->type, "orthographic");
  EXPECT_EQ(scene.camera->world_to_camera.start,
            parse(std::string(kOwn) + "WorldBegin").camera->world_to_camera.start);
  EXPECT_EQ(scene.film->type, "rgb");
  EXPECT_EQ(scene.film->parameters.get_int("xresolution", 0), 7);
  EXPECT_EQ(scene.color_space, "srgb");
  EXPECT_EQ(parse_warnings(kept()), "");
}

TEST(KeepCamera, WithoutItTheLastOnesCountWithWarnings) {
  const SceneDescription scene = parse(kept("false"));
  EXPECT_EQ(scene.camera->type, "perspective");
  EXPECT_EQ(scene.film->type, "gbuffer");
  const std::string warnings = parse_warnings(kept("false"));
  EXPECT_NE(warnings.find("Camera was already given"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("Film was already given"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("TransformTimes after Camera"), std::string::npos) << warnings;
}

// All but camera and film is as in the included scene alone.
TEST(KeepCamera, TheRestOfTheSceneStays) {
  const SceneDescription scene = parse(kept()), alone = parse(kIncluded);
  EXPECT_EQ(scene.media[0].transform.start, alone.media[0].transform.start);
  EXPECT_EQ(scene.transform_end_time, 2);
  EXPECT_NE(alone.lights[0].transform.start, Mat44d());
  EXPECT_EQ(scene.lights[0].transform.start, alone.lights[0].transform.start);
}

TEST(KeepCamera, IsNoOptionOfTheScene) {
  const TemporaryDirectory directory;
  const SceneDescription scene = parse(kept());
  EXPECT_TRUE(scene.options.empty());
  write_pbrt(scene, directory.path("converted.pbrt"));
  Diagnostics diagnostics;
  const SceneDescription again = parse_pbrt_file(directory.path("converted.pbrt"), diagnostics);
  EXPECT_EQ(again.camera->type, "orthographic");
  EXPECT_EQ(again.camera->world_to_camera.start, scene.camera->world_to_camera.start);
}

TEST(KeepCamera, IsWarnedOfInTheWorldAndRefusedWithOtherTypes) {
  EXPECT_EQ(parse_warnings("WorldBegin Option \"bool keepcamera\" true"),
            "t.pbrt:1:19: option \"keepcamera\" has no effect after WorldBegin, expected it before "
            "the Camera\n");
  EXPECT_EQ(testing::parse_error("Option \"integer keepcamera\" 1 WorldBegin"),
            "t.pbrt:1:8: option \"keepcamera\" has type \"integer\", expected \"bool\"");
}

}  // namespace
}  // namespace nephroid
