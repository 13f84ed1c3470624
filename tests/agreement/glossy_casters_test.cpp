// Caustics of glossy materials: camera paths whose photons are merged behind an S or G event find
// the same picture as camera paths alone, at any roughness.
#include <gtest/gtest.h>

#include "caster_pictures.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr ClassMask kGlossyToo = ClassMask::kSpecular | ClassMask::kGlossy;

struct Casters {
  const char* name;
  const char* alpha;
  const char* lamp;
};
constexpr const char* kPoint = R"(LightSource "point" "rgb I" [9 8 7] "point3 from" [1 3 0.5])";
// A disk lamp, and a mirror: camera paths cannot find its caustic if the lamp is a point.
constexpr const char* kDisk = R"(
  AttributeBegin Translate 1 3 0.5 Rotate 90 1 0 0
  AreaLightSource "diffuse" "rgb L" [20 18 16] "bool twosided" true
  Shape "disk" "float radius" 0.3 AttributeEnd
  Material "conductor"
  Shape "bilinearmesh" "point3 P" [-1 0.2 0.9  0.5 0.2 0.9  -1 0.7 0.9  0.5 0.7 0.9])";
constexpr const char* kWindow = R"(
  AreaLightSource "diffuse" "rgb L" [3 2.8 2.6] "bool twosided" true
  Shape "bilinearmesh" "point3 P" [-1.5 0.5 2  1.5 0.5 2  -1.5 2.5 2  1.5 2.5 2]
  AreaLightSource "diffuse" "rgb L" [0 0 0])";
const Casters kCasters[] = {{"smooth_glass_and_a_window", "0.02", kWindow},
                            {"polished_glass_and_a_window", "0.05", kWindow},
                            {"frosted_glass_and_a_disk", "0.1", kDisk},
                            {"rough_glass", "0.3", kPoint},
                            {"rough_glass_and_a_disk", "0.3", kDisk},
                            {"rougher_glass_and_a_disk", "0.5", kDisk}};

/// A ball of the glass and a sheet of rough metal. Both stand clear of the floor, so that no light
/// is merged beyond an edge.
std::string world(const Casters& casters) {
  return std::string(casters.lamp) + "\n" +
         "Material \"dielectric\" \"float eta\" 1.5 \"bool remaproughness\" false "
         "\"float roughness\" " +
         casters.alpha + R"(
    AttributeBegin Translate -0.5 0.5 0 Shape "sphere" "float radius" 0.4 AttributeEnd
    Material "conductor" "rgb reflectance" [0.9 0.7 0.4] "bool remaproughness" false
      "float roughness" 0.15
    Shape "bilinearmesh" "point3 P" [0.8 0.2 0.9  1.2 0.2 -0.5  0.8 0.8 0.9  1.2 0.8 -0.5])";
}

/// A smooth ball over a sheet of rough metal. Only photons find its caustic of a point light.
const char* const kCausticOnMetal = R"(
  LightSource "point" "rgb I" [9 8 7] "point3 from" [1 3 0.5]
  Material "conductor" "rgb reflectance" [0.9 0.7 0.4] "bool remaproughness" false
    "float roughness" 0.4
  Shape "bilinearmesh" "point3 P" [-1.5 0.1 -1  1 0.1 -1  -1.5 0.1 1  1 0.1 1]
  Material "dielectric" "float eta" 1.5
  AttributeBegin Translate 0 0.7 0 Shape "sphere" "float radius" 0.4 AttributeEnd
  Material "dielectric" "float eta" 1.5 "bool remaproughness" false "float roughness" 0.3
  AttributeBegin Translate -1 0.6 0 Shape "sphere" "float radius" 0.3 AttributeEnd)";

PairTechniques merging(ClassMask casters) {
  return {.light_paths = 16384, .connects = false, .casters = casters};
}

class GlossyCasters : public ::testing::TestWithParam<Casters> {};

TEST_P(GlossyCasters, PhotonsAndWalksFindWhatWalksAloneFind) {
  const CasterPictures of{PairView(world(GetParam()))};
  expect_equal(of.pictures(merging(kGlossyToo), 1, 64), of.pictures(camera_paths_only(), 1000, 256),
               GetParam().name);
}

TEST_P(GlossyCasters, PhotonsOfIndirectLightAndWalksFindWhatWalksAloneFind) {
  const CasterPictures of{PairView(world(GetParam()))};
  expect_equal(of.pictures(merging(ClassMask::kAll), 1, 64),
               of.pictures(camera_paths_only(), 1000, 256), GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(Roughness, GlossyCasters, ::testing::ValuesIn(kCasters),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SpecularCasters, ThrowCausticsOntoMetalWhicheverCastersCount) {
  const CasterPictures of{PairView(kCausticOnMetal)};
  expect_equal(of.pictures(merging(kGlossyToo), 1, 64),
               of.pictures(merging(ClassMask::kSpecular), 1000, 64), "metal");
  expect_equal(of.pictures(merging(ClassMask::kAll), 2000, 64),
               of.pictures(merging(ClassMask::kSpecular), 1000, 64), "metal, any caster");
}

}  // namespace
}  // namespace nephroid
