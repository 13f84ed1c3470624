// A camera as text: for the clipboard, and as a scene that includes the old one.
#include "session/camera_text.h"

#include <gtest/gtest.h>

#include "input/convert/pbrt_writer.h"
#include "input/scene_reader.h"
#include "rendering.h"
#include "same_bits.h"
#include "session/camera_edit.h"
#include "unit/input/temporary_directory.h"
#include "unit/session/camera_scenes.h"

namespace nephroid {
namespace {

using testing::built;
using testing::camera_transforms;
using testing::description_of;
using testing::difference;
using testing::expect_same_rays;
using testing::kBall;
using testing::TemporaryDirectory;

SceneDescription seen_by(const std::string& transform) {
  return description_of(transform + " Camera \"perspective\" \"float fov\" 30" + kBall);
}

TEST(CameraText, IsALookAtAndACamera) {
  EXPECT_EQ(camera_text(seen_by("LookAt 0 0 -5  0 0 0.1  0 1 0")),
            "LookAt 0 0 -5  0 0 5  0 1 0\nCamera \"perspective\" \"float fov\" [ 30 ]\n");
  EXPECT_EQ(camera_text(seen_by("Scale -1 1 1 LookAt 0.3 40 -7  0.3 40 8  0 2 0")),
            "Scale -1 1 1\nLookAt 0.3 40 -7  0.3 40 93  0 1 0\n"
            "Camera \"perspective\" \"float fov\" [ 30 ]\n");
  EXPECT_EQ(camera_text(description_of(kBall)),
            "LookAt 0 0 0  0 0 1  0 1 0\nCamera \"perspective\"\n");
}

TEST(CameraText, PastedGivesTheSameCamera) {
  for (const std::string& transform : camera_transforms()) {
    const SceneDescription scene = seen_by(transform);
    const std::string text = camera_text(scene);
    const SceneDescription pasted = description_of(text + kBall);
    EXPECT_LT(difference(pasted.camera->world_to_camera.start, scene.camera->world_to_camera.start),
              1e-7)
        << text;
    EXPECT_EQ(pasted.camera->parameters.get_float("fov", 0), 30);
  }
}

TEST(CameraText, HasBothEndsOfAMotion) {
  const SceneDescription scene = seen_by(
      "TransformTimes 0.5 2 Scale -1 1 1 ActiveTransform EndTime Rotate 20 0 1 0 "
      "ActiveTransform All LookAt 3 1 4  0 0 0  0 1 0");
  const SceneDescription pasted = description_of(camera_text(scene) + kBall);
  const TransformDescription &a = pasted.camera->world_to_camera,
                             &b = scene.camera->world_to_camera;
  EXPECT_LT(difference(a.start, b.start), 1e-7);
  EXPECT_LT(difference(a.end, b.end), 1e-7);
  EXPECT_GT(difference(a.end, a.start), 0.1);
  EXPECT_EQ(pasted.transform_start_time, 0.5f);
  EXPECT_EQ(pasted.transform_end_time, 2);
}

/// A scene that uses most of what a camera and its file can have.
constexpr const char* kOld = R"(
  TransformTimes 0 2
  Scale -1 1 1 LookAt 1 2 -9  0 0.5 0  0 1 0
  MakeNamedMedium "fog" "string type" "homogeneous" "float scale" 0.01
  MediumInterface "" "fog"
  Camera "perspective" "float fov" 30 "float lensradius" 0.1 "float focaldistance" 9
  ColorSpace "rec2020"
  Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "float iso" 150
  Sampler "sobol" "integer pixelsamples" 4
  WorldBegin
  ColorSpace "srgb"
  AttributeBegin
  CoordSysTransform "camera" LightSource "point" "point3 from" [1 1 1]
  AttributeEnd
  LightSource "infinite"
  Material "dielectric" Shape "sphere" "float radius" 2
)";

CameraPose moved(const SceneDescription& description) {
  CameraPose pose = camera_pose(description, *built(description));
  pose.eye += Vec3d(0.3, 1, 0.7);
  pose.fov = 41.7;
  return pose;
}

class SceneText : public ::testing::Test {
 protected:
  SceneText() { directory_.write("old.pbrt", kOld); }

  SceneDescription read(const std::string& name) {
    Diagnostics diagnostics;
    SceneDescription scene = parse_pbrt_file(directory_.path(name), diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty()) << diagnostics.warnings()[0].message;
    return scene;
  }
  SceneDescription saved_and_read(const SceneDescription& scene, const std::string& included,
                                  const std::string& name) {
    directory_.write(name, scene_text_with_camera(scene, included));
    return read(name);
  }

  const TemporaryDirectory directory_;
};

TEST_F(SceneText, SavedAndReadGivesTheSamePicture) {
  SceneDescription scene = read("old.pbrt");
  set_camera(&scene, moved(scene));
  set_resolution(&scene, 20, 12);
  const SceneDescription again = saved_and_read(scene, "old.pbrt", "new.pbrt");
  EXPECT_EQ(again.camera->world_to_camera.start, scene.camera->world_to_camera.start);
  EXPECT_EQ(again.camera->medium, "fog");
  EXPECT_EQ(again.color_space, "rec2020");
  EXPECT_EQ(again.transform_end_time, 2);
  EXPECT_EQ(again.lights[0].transform.start, scene.lights[0].transform.start);
  EXPECT_EQ(again.media[0].transform.start, scene.media[0].transform.start);
  const auto a = built(scene), b = built(again);
  EXPECT_EQ(b->film.width, 20);
  EXPECT_EQ(camera_pose(scene, *a).eye, camera_pose(again, *b).eye);
  expect_same_rays(*a, *b);
  testing_support::expect_same_bits(testing_support::render(*a, "path", {}, 1, 2),
                                    testing_support::render(*b, "path", {}, 1, 2), "saved");
}

TEST_F(SceneText, OfASavedSceneCanBeSavedAgain) {
  SceneDescription scene = read("old.pbrt");
  set_camera(&scene, moved(scene));
  SceneDescription again = saved_and_read(scene, "old.pbrt", "new.pbrt");
  set_camera(&again, moved(again));
  const SceneDescription third = saved_and_read(again, "new.pbrt", "newer.pbrt");
  EXPECT_EQ(third.camera->world_to_camera.start, again.camera->world_to_camera.start);
  expect_same_rays(*built(again), *built(third));
}

TEST_F(SceneText, KeepsAMotion) {
  SceneDescription scene = read("old.pbrt");
  Mat44d& end = scene.camera->world_to_camera.end;
  end[3][0] += 1.0 / 3;
  const SceneDescription again = saved_and_read(scene, "old.pbrt", "new.pbrt");
  EXPECT_EQ(again.camera->world_to_camera.end, end);
  expect_same_rays(*built(scene), *built(again));
}

TEST_F(SceneText, OfASceneWithoutCameraAndFilm) {
  directory_.write("bare.pbrt", "WorldBegin Shape \"sphere\"");
  SceneDescription scene = read("bare.pbrt");
  set_camera(&scene, moved(scene));
  const SceneDescription again = saved_and_read(scene, "bare.pbrt", "new.pbrt");
  expect_same_rays(*built(scene), *built(again));
}

// Other formats cannot be included: their description is written whole.
TEST_F(SceneText, EditedScenesOfOtherFormatsAreWrittenWhole) {
  EXPECT_TRUE(is_pbrt_scene("a/b.pbrt"));
  EXPECT_TRUE(is_pbrt_scene("b.pbrt.gz"));
  EXPECT_FALSE(is_pbrt_scene("b.OBJ"));
  EXPECT_FALSE(is_pbrt_scene("b.glb"));
  directory_.write("old.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  Diagnostics diagnostics;
  SceneDescription scene = read_scene(directory_.path("old.obj"), {}, diagnostics);
  set_camera(&scene, moved(scene));
  write_pbrt(scene, directory_.path("new.pbrt"));
  const SceneDescription again = read("new.pbrt");
  EXPECT_EQ(again.camera->world_to_camera.start, scene.camera->world_to_camera.start);
  expect_same_rays(*built(scene), *built(again));
}

}  // namespace
}  // namespace nephroid
