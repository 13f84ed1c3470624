// A built scene with a new camera gives the picture of a scene that was built with it.
#include <gtest/gtest.h>

#include "rendering.h"
#include "same_bits.h"
#include "scene/scene_view.h"
#include "session/camera_edit.h"
#include "unit/session/camera_scenes.h"

namespace nephroid {
namespace {

using testing::built;
using testing::description_of;
using testing::expect_same_rays;

constexpr const char* kFirstCamera = R"(
  Scale -1 1 1 LookAt 1 2 -9  0 0.5 0  0 1 0
  Camera "perspective" "float fov" 30
)";
constexpr const char* kRenewedWorld = R"(
  Film "rgb" "integer xresolution" 24 "integer yresolution" 16
  Sampler "sobol" "integer pixelsamples" 4
  MakeNamedMedium "fog" "string type" "homogeneous" "float scale" 0.02
  WorldBegin
  LightSource "infinite"
  AttributeBegin
  Translate 0 5 0 Rotate 90 1 0 0 AreaLightSource "diffuse" Shape "disk"
  AttributeEnd
  Shape "bilinearmesh" "point3 P" [-9 -1 -9  9 -1 -9  -9 -1 9  9 -1 9]
  AttributeBegin
  Material "interface" MediumInterface "fog" "" Shape "sphere" "float radius" 3
  AttributeEnd
  MediumInterface "fog" "fog"
  Material "dielectric" Shape "sphere"
)";

/// Builds with the first camera, renews to that of `wanted`, and compares with a scene that was
/// built for it.
void expect_renewed_is_built(const SceneDescription& wanted, const SceneOverrides& overrides) {
  const SceneDescription first = description_of(std::string(kFirstCamera) + kRenewedWorld);
  const auto scene = built(first, overrides), expected = built(wanted, overrides);
  Diagnostics diagnostics;
  renew_camera(*scene, wanted, overrides, diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  expect_same_rays(*scene, *expected);
  EXPECT_EQ(scene->camera_medium != nullptr, expected->camera_medium != nullptr);
  for (size_t i = 0; i < expected->lights.size(); ++i)
    EXPECT_EQ(scene->light_media[i].outside != nullptr,
              expected->light_media[i].outside != nullptr);
  testing_support::expect_same_bits(testing_support::render(*scene, "path", {}, 3, 2),
                                    testing_support::render(*expected, "path", {}, 3, 2),
                                    "renewed");
}

TEST(RenewCamera, GivesThePictureOfASceneBuiltWithIt) {
  for (const char* camera :
       {"LookAt 4 3 -6  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 50 \"float lensradius\" "
        "0.2 \"float focaldistance\" 7",
        "Scale 0.2 0.2 0.2 LookAt 4 3 -6  0 0 0  0 1 0 Camera \"orthographic\"",
        "Translate 0 -1 4 Camera \"spherical\" \"float shutterclose\" 0.5",
        "LookAt 1 0 -2  0 0 0  0 1 0 MediumInterface \"\" \"fog\" Camera \"perspective\" "
        "MediumInterface \"\" \"\""})
    expect_renewed_is_built(description_of(std::string(camera) + kRenewedWorld), {});
}

TEST(RenewCamera, TakesAMovedCameraAndTheResolutionAndCropOfTheCommandLine) {
  SceneDescription wanted = description_of(std::string(kFirstCamera) + kRenewedWorld);
  CameraPose pose = camera_pose(wanted, *built(wanted));
  pose.eye = Vec3d(2, 1, -7);
  pose.fov = 44;
  set_camera(&wanted, pose);
  SceneOverrides overrides;
  overrides.width = 30;
  overrides.height = 20;
  overrides.has_crop = true;
  overrides.crop[0] = 0.5f;
  expect_renewed_is_built(wanted, overrides);
}

TEST(RenewCamera, ChangesNothingIfItFails) {
  SceneDescription description = description_of(std::string(kFirstCamera) + kRenewedWorld);
  const auto scene = built(description);
  const Camera* camera = scene->camera.get();
  Diagnostics diagnostics;
  const auto expect_error = [&](const SceneDescription& broken, const SceneOverrides& overrides) {
    EXPECT_THROW(renew_camera(*scene, broken, overrides, diagnostics), Error);
    EXPECT_EQ(scene->camera.get(), camera);
    EXPECT_EQ(scene->film.width, 24);
    EXPECT_EQ(scene->camera_medium, nullptr);
  };
  SceneOverrides empty;
  empty.width = 100;
  empty.has_crop = true;
  empty.crop[1] = 0;
  expect_error(description, empty);
  SceneDescription other = description;
  set_resolution(&other, 50, 50);
  other.camera->type = "unheard of";
  other.camera->medium = "fog";
  expect_error(other, {});
  other = description;
  other.camera->medium = "soup";
  expect_error(other, {});
}

}  // namespace
}  // namespace nephroid
