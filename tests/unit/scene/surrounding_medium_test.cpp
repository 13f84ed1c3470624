// The medium around a scene, and infinite lights in it.
#include "scene/surrounding_medium.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"

namespace nephroid {
namespace {

constexpr const char* kWater =
    "MakeNamedMedium \"water\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 1 1] \"rgb "
    "sigma_s\" [0 0 0]\n";

std::unique_ptr<Scene> scene_in_medium(const std::string& text) {
  Diagnostics diagnostics;
  return build_scene(parse_pbrt_string(text, "test.pbrt", ".", diagnostics), {}, diagnostics);
}

std::string ball_in(const std::string& inside, const std::string& outside) {
  return "AttributeBegin\nMaterial \"interface\"\nMediumInterface \"" + inside + "\" \"" + outside +
         "\"\nShape \"sphere\" \"float radius\" 3\nAttributeEnd\n";
}

constexpr const char* kLights =
    "LightSource \"infinite\"\nLightSource \"distant\"\nLightSource \"point\"\n";

TEST(SurroundingMedium, OfACameraInABallOfWaterIsEmptySpace) {
  const auto scene = scene_in_medium(std::string(kWater) +
                                     "MediumInterface \"\" \"water\"\nCamera \"perspective\"\n" +
                                     "WorldBegin\n" + kLights + ball_in("water", ""));
  const auto medium = surrounding_medium(*scene);
  ASSERT_TRUE(medium);
  EXPECT_EQ(*medium, nullptr);
  // The file has set water for all three lights. The point light is in it.
  EXPECT_EQ(scene->light_media[0].outside, nullptr);
  EXPECT_EQ(scene->light_media[1].outside, nullptr);
  EXPECT_EQ(scene->light_media[2].outside, scene->camera_medium);
}

TEST(SurroundingMedium, IsTheCamerasWithoutAnyBoundary) {
  const auto scene = scene_in_medium(std::string(kWater) +
                                     "MediumInterface \"\" \"water\"\nCamera \"perspective\"\n"
                                     "WorldBegin\nMediumInterface \"\" \"\"\n" +
                                     kLights + "Shape \"sphere\" \"float radius\" 3\n");
  const auto medium = surrounding_medium(*scene);
  ASSERT_TRUE(medium);
  ASSERT_NE(*medium, nullptr);
  EXPECT_EQ(*medium, scene->camera_medium);
  EXPECT_EQ(scene->light_media[0].outside, scene->camera_medium);
}

TEST(SurroundingMedium, IsUnknownAboveAnOpenSurfaceOfWater) {
  const auto scene =
      scene_in_medium(std::string(kWater) + "Camera \"perspective\"\nWorldBegin\n" + kLights +
                      "Material \"interface\"\nMediumInterface \"water\" \"\"\n"
                      "Shape \"bilinearmesh\" \"point3 P\" [-9 -1 9  9 -1 9  -9 -1 -9  9 -1 -9]\n");
  EXPECT_FALSE(surrounding_medium(*scene));
  EXPECT_EQ(scene->light_media[0].outside, nullptr);
}

// A floor that names media for its sides the wrong way around.
TEST(MediumTowards, LightThatIsReflectedStaysInItsMedium) {
  const auto scene = scene_in_medium(std::string(kWater) + "Camera \"perspective\"\nWorldBegin\n" +
                                     ball_in("water", ""));
  const Medium* const water = scene->media[0].get();
  Ray ray;
  ray.o = Vec3f(0, 0, 5);
  ray.d = Vec3f(0, 0, -1);
  SurfaceInteraction hit;
  ASSERT_TRUE(scene->intersect(ray, hit));
  const Vec3f out(0, 0, 1);
  EXPECT_EQ(medium_beyond(hit, out, water), nullptr);
  EXPECT_EQ(medium_beyond(hit, -out, nullptr), water);
  EXPECT_EQ(medium_towards(hit, -out, nullptr), water) << "into the ball";
  EXPECT_EQ(medium_towards(hit, out, nullptr), nullptr) << "back";
  EXPECT_EQ(medium_towards(hit, out, water), water)
      << "back, from where the ball says there is none";
  hit.wo = -out;
  EXPECT_EQ(medium_towards(hit, out, water), nullptr) << "out of the ball";
  EXPECT_EQ(medium_towards(hit, -out, nullptr), nullptr) << "back inside";
}

}  // namespace
}  // namespace nephroid
