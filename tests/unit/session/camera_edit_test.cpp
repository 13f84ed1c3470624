// A camera is read from a description, moved, and written back.
#include "session/camera_edit.h"

#include <limits>

#include "unit/input/parse_text.h"
#include "unit/session/camera_scenes.h"

namespace nephroid {
namespace {

using testing::built;
using testing::camera_transforms;
using testing::description_of;
using testing::difference;
using testing::error_of;
using testing::kBall;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SceneDescription with_camera(const std::string& transform,
                             const std::string& camera = "\"perspective\" \"float fov\" 30") {
  return description_of(transform + " Camera " + camera + kBall);
}

CameraPose pose_of(const SceneDescription& description) {
  return camera_pose(description, *built(description));
}

Mat44d matrix_of(const SceneDescription& description) {
  return description.camera->world_to_camera.start;
}

/// A pose that has nothing in common with the cameras of the tests.
CameraPose other_pose() {
  CameraPose pose;
  pose.eye = Vec3d(-3, 5, 7);
  pose.target = Vec3d(0.5, 0.25, -1);
  pose.up = Vec3d(0.1, 1, -0.2);
  return pose;
}

TEST(CameraPose, SetAgainChangesNothing) {
  for (const std::string& transform : camera_transforms()) {
    SceneDescription scene = with_camera(transform);
    const Mat44d before = matrix_of(scene);
    set_camera(&scene, pose_of(scene));
    EXPECT_EQ(matrix_of(scene), before) << transform;
    EXPECT_EQ(scene.camera->parameters.list.size(), 1u) << transform;
  }
}

TEST(CameraPose, SetAfterAnotherOneGivesTheSameMatrix) {
  for (const std::string& transform : camera_transforms()) {
    SceneDescription scene = with_camera(transform);
    const Mat44d before = matrix_of(scene);
    const CameraPose pose = pose_of(scene);
    set_camera(&scene, other_pose());
    EXPECT_GT(difference(matrix_of(scene), before), 0.1) << transform;
    set_camera(&scene, pose);
    EXPECT_LT(difference(matrix_of(scene), before), 1e-12) << transform;
  }
}

TEST(CameraPose, IsThatOfALookAt) {
  const CameraPose pose = pose_of(with_camera("Scale -1 1 1 LookAt 1 2 -8  0 1 0  0 3 0"));
  EXPECT_LT((pose.eye - Vec3d(1, 2, -8)).length(), 1e-14);
  EXPECT_LT((pose.target - pose.eye).cross(Vec3d(-1, -1, 8)).length(), 1e-12);
  EXPECT_EQ(pose.up, Vec3d(0, 1, 0));
}

// The rays of the moved camera, whatever its own space is: the middle of the picture looks from the
// eye to the target, and the upper half of the picture is up.
TEST(SetCamera, MovesTheRays) {
  for (const std::string& transform : camera_transforms()) {
    SceneDescription scene = with_camera(transform);
    const bool mirrored = Transform(matrix_of(scene)).swaps_handedness();
    const CameraPose pose = other_pose();
    set_camera(&scene, pose);
    EXPECT_EQ(Transform(matrix_of(scene)).swaps_handedness(), mirrored) << transform;
    const auto moved = built(scene);
    const auto middle = moved->camera->generate_ray(Vec2f(12, 8), Vec2f(0.5f, 0.5f), 0.5f);
    const auto above = moved->camera->generate_ray(Vec2f(12, 2), Vec2f(0.5f, 0.5f), 0.5f);
    EXPECT_LT(length(middle->ray.o - Vec3f(pose.eye)), 1e-5f) << transform;
    const Vec3d view = (pose.target - pose.eye).normalized();
    EXPECT_LT(length(middle->ray.d - Vec3f(view)), 1e-6f) << transform;
    EXPECT_GT(dot(above->ray.d - middle->ray.d, Vec3f(pose.up)), 0.01f) << transform;
  }
}

TEST(SetCamera, ReplacesTheValuesThatThePoseHas) {
  SceneDescription scene =
      with_camera("", "\"perspective\" \"float fov\" 30 \"float lensradius\" 1");
  CameraPose pose = other_pose();
  pose.fov = 50;
  pose.focal_distance = 7;
  pose.shutter_open = 0.25;
  pose.shutter_close = 0.5;
  set_camera(&scene, pose);
  EXPECT_EQ(scene.camera->parameters.list.size(), 5u);
  const ParameterSet& p = scene.camera->parameters;
  EXPECT_EQ(p.get_float("fov", 0), 50);
  EXPECT_EQ(p.get_float("lensradius", 0), 1);
  EXPECT_EQ(p.get_float("focaldistance", 0), 7);
  EXPECT_EQ(p.get_float("shutteropen", 0), 0.25f);
  EXPECT_EQ(p.get_float("shutterclose", 0), 0.5f);
  EXPECT_EQ(pose_of(scene).fov, 50);
  EXPECT_EQ(pose_of(scene).lens_radius, 1);
  EXPECT_EQ(built(scene)->film.imaging_ratio, 0.25f);
}

TEST(SetCamera, OnlyTypesWithALensHaveItsValues) {
  const CameraPose perspective = pose_of(with_camera("", "\"perspective\""));
  EXPECT_EQ(perspective.fov, 90);
  EXPECT_EQ(perspective.lens_radius, 0);
  EXPECT_EQ(perspective.focal_distance, 1e6);
  EXPECT_EQ(perspective.shutter_close, 1);
  const CameraPose orthographic = pose_of(with_camera("", "\"orthographic\""));
  EXPECT_FALSE(orthographic.fov);
  EXPECT_EQ(orthographic.lens_radius, 0);
  SceneDescription spherical = with_camera("", "\"spherical\" \"float lensradius\" 3");
  EXPECT_FALSE(pose_of(spherical).lens_radius);
  EXPECT_FALSE(pose_of(spherical).fov);
  CameraPose pose = other_pose();
  pose.fov = 20;
  const Mat44d before = matrix_of(spherical);
  EXPECT_EQ(error_of([&] { set_camera(&spherical, pose); }),
            "camera: a camera of type \"spherical\" has no \"fov\", expected no value for it");
  EXPECT_EQ(matrix_of(spherical), before);
  pose.fov.reset();
  set_camera(&spherical, pose);
  EXPECT_NE(matrix_of(spherical), before);
}

TEST(SetCamera, AddsACamera) {
  SceneDescription scene = description_of(kBall);
  const CameraPose pose = pose_of(scene);
  EXPECT_EQ(pose.eye, Vec3d(0, 0, 0));
  EXPECT_EQ(pose.fov, 90);
  set_camera(&scene, other_pose());
  EXPECT_EQ(scene.camera->type, "perspective");
  EXPECT_LT((pose_of(scene).eye - other_pose().eye).length(), 1e-12);
}

constexpr const char* kMovingCamera = R"(
  TransformTimes 1 3
  ActiveTransform EndTime Translate -4 0 0 ActiveTransform All
  Scale -1 1 1 LookAt 0 0 -9  0 0 0  0 1 0
  Camera "perspective" "float shutteropen" 2 "float shutterclose" 3
)";

TEST(SetCamera, AMovingCameraStandsStillOnceItIsMoved) {
  SceneDescription scene = description_of(std::string(kMovingCamera) + kBall);
  const TransformDescription motion = scene.camera->world_to_camera;
  ASSERT_TRUE(motion.is_animated());
  CameraPose pose = pose_of(scene);
  // The shutter opens in the middle of the motion.
  const Vec3f there = built(scene)->camera->camera_to_world(0.5f).point(Vec3f(0, 0, 0));
  EXPECT_NEAR(std::abs(there.x), 2, 1e-6);
  EXPECT_LT((pose.eye - to_double(there)).length(), 1e-6);

  pose.fov = 33;
  set_camera(&scene, pose);
  EXPECT_EQ(scene.camera->world_to_camera.start, motion.start);
  EXPECT_EQ(scene.camera->world_to_camera.end, motion.end);

  pose.eye.y += 1;
  set_camera(&scene, pose);
  EXPECT_FALSE(scene.camera->world_to_camera.is_animated());
  EXPECT_LT((pose_of(scene).eye - pose.eye).length(), 1e-12);
  pose.eye.y -= 1;
  set_camera(&scene, pose);
  const Mat44d middle = built(description_of(std::string(kMovingCamera) + kBall))
                            ->camera->camera_to_world(0.5f)
                            .inverse;
  EXPECT_LT(difference(matrix_of(scene), middle), 1e-12);
}

TEST(CameraPose, TheTargetIsInFocusOrBesideTheMiddleOfTheScene) {
  const std::string far = "LookAt 0 0 -20  0 1 0  0 1 0";
  const CameraPose sharp = pose_of(with_camera(far));
  EXPECT_NEAR((sharp.target - Vec3d(0, 0, 0)).dot(sharp.target - sharp.eye), 0, 1e-4);
  // A scale of camera space scales the distance of the focus.
  const CameraPose lens = pose_of(with_camera(
      "Scale 2 2 2 " + far, "\"perspective\" \"float lensradius\" 1 \"float focaldistance\" 10"));
  EXPECT_NEAR((lens.target - lens.eye).length(), 5, 1e-12);
  const CameraPose infinite = pose_of(with_camera(far, "\"perspective\" \"float lensradius\" 1"));
  EXPECT_NEAR((infinite.target - infinite.eye).length(), (sharp.target - sharp.eye).length(), 1e-9);
  const CameraPose away = pose_of(with_camera("LookAt 0 0 -20  0 0 -30  0 1 0"));
  EXPECT_GT((away.target - away.eye).length(), 1);
}

TEST(SetCamera, RefusesPosesThatAreNone) {
  SceneDescription scene = with_camera("LookAt 0 0 -20  0 1 0  0 1 0");
  const Mat44d before = matrix_of(scene);
  const auto error = [&](const auto& edit) {
    CameraPose pose = other_pose();
    edit(pose);
    return error_of([&] { set_camera(&scene, pose); });
  };
  EXPECT_EQ(error([](CameraPose& p) { p.eye = p.target; }),
            "camera: eye and target are the same point, expected two different points");
  const std::string far =
      "camera: the eye or the target is too far away or not a number, expected coordinates up to "
      "1e17";
  EXPECT_EQ(error([](CameraPose& p) { p.eye.x = kNan; }), far);
  EXPECT_EQ(error([](CameraPose& p) { p.target.y = 1e18; }), far);
  const std::string up =
      "camera: the up vector is zero, not a number, or parallel to the view, expected another "
      "direction";
  EXPECT_EQ(error([](CameraPose& p) { p.up = Vec3d(0, 0, 0); }), up);
  EXPECT_EQ(error([](CameraPose& p) { p.up = p.eye - p.target; }), up);
  EXPECT_EQ(error([](CameraPose& p) { p.up.z = kNan; }), up);
  EXPECT_EQ(error([](CameraPose& p) { p.fov = 180; }),
            "camera: the field of view is 180 degrees, expected more than 0 and below 180");
  EXPECT_EQ(error([](CameraPose& p) { p.fov = kNan; }),
            "camera: \"fov\" is not a finite float, expected a finite number");
  EXPECT_EQ(error([](CameraPose& p) { p.lens_radius = -1; }),
            "camera: the lens radius is -1, expected 0 or more");
  EXPECT_EQ(error([](CameraPose& p) { p.focal_distance = 0; }),
            "camera: the focal distance is 0, expected more than 0");
  EXPECT_EQ(error([](CameraPose& p) { p.shutter_open = 2; }),
            "camera: the shutter opens at 2 and closes at 1, expected it to close later");
  EXPECT_EQ(matrix_of(scene), before);
  EXPECT_EQ(scene.camera->parameters.list.size(), 1u);
}

TEST(SetResolution, SetsTheFilmOrAddsOne) {
  SceneDescription scene = with_camera("");
  set_resolution(&scene, 50, 40);
  EXPECT_EQ(built(scene)->film.width, 50);
  EXPECT_EQ(built(scene)->film.height, 40);
  scene.film.reset();
  set_resolution(&scene, 5, 4);
  EXPECT_EQ(built(scene)->film.crop_x1, 5);
}

}  // namespace
}  // namespace nephroid
