// Photons of media: camera paths that merge them along their flights find the same picture as
// camera paths that scatter there themselves, and caustics in the medium besides.
#include <gtest/gtest.h>

#include "caster_pictures.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

PairTechniques gathering_in_media() {
  return {.light_paths = 16384,
          .connects = false,
          .casters = ClassMask::kAll,
          .gathers_in_media = true};
}

struct FogOf {
  const char* name;
  const char* medium;
};
// Absorption and scattering vary with wavelength.
const FogOf kFogs[] = {{"uniform", R"("string type" "homogeneous" "float g" 0.4
        "rgb sigma_a" [0.1 0.2 0.3] "rgb sigma_s" [0.6 0.4 0.3])"},
                       {"grid", R"("string type" "uniformgrid" "float g" -0.3
        "integer nx" 2 "integer ny" 2 "integer nz" 2 "point3 p0" [-3 -0.5 -3] "point3 p1" [3 3.5 3]
        "float density" [0.2 1 1 0.4 0.9 0.1 0.3 0.8]
        "rgb sigma_a" [0.1 0.2 0.3] "rgb sigma_s" [1.2 0.9 0.7])"}};

/// Floor, a ball and a lamp in a box of fog, which begins below the camera.
std::string in_fog(const FogOf& fog, const std::string& things) {
  return "MakeNamedMedium \"fog\" " + std::string(fog.medium) + R"(
    AttributeBegin
      Material "interface" MediumInterface "fog" ""
      Translate 0 1.5 0 Scale 2.5 1.9 2.5
      Shape "trianglemesh" "point3 P" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1
                                       -1 -1 1  1 -1 1  1 1 1  -1 1 1]
        "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4
                             3 7 6 3 6 2  0 4 7 0 7 3  1 2 6 1 6 5]
    AttributeEnd
    MediumInterface "fog" "fog"
  )" + things;
}

const char* const kDiffuseBall = R"(
  AttributeBegin Translate 0.9 2.2 0.5 Rotate 90 1 0 0
  AreaLightSource "diffuse" "rgb L" [20 18 16] "bool twosided" true
  Shape "disk" "float radius" 0.3 AttributeEnd
  Material "diffuse" "rgb reflectance" [0.7 0.5 0.3]
  AttributeBegin Translate -0.5 0.6 0 Shape "sphere" "float radius" 0.5 AttributeEnd)";

class MediumPhotonsIn : public ::testing::TestWithParam<FogOf> {};

TEST_P(MediumPhotonsIn, FindWhatWalksAloneFind) {
  const CasterPictures of{PairView(in_fog(GetParam(), kDiffuseBall))};
  expect_equal(of.pictures(gathering_in_media(), 1, 16),
               of.pictures(camera_paths_only(), 1000, 320), GetParam().name);
}

// Without fog, light samples leave the dim part of a sky to walks.
TEST_P(MediumPhotonsIn, FindTheLightOfASky) {
  const CasterPictures of{PairView(in_fog(GetParam(), R"(
    LightSource "infinite" "string filename" "../scenes/gallery/sky.pfm"
    Material "diffuse" "rgb reflectance" [0.7 0.5 0.3]
    AttributeBegin Translate -0.5 0.6 0 Shape "sphere" "float radius" 0.5 AttributeEnd)"))};
  PairTechniques gathering = gathering_in_media();
  gathering.light_paths *= 4;  // few of them meet the fog
  expect_equal(of.pictures(gathering, 1, 16), of.pictures(camera_paths_only(), 1000, 320),
               GetParam().name);
}

TEST(MediumPhotonsInUnevenFog, FindWhatWalksFindBehindGlass) {
  // The camera looks through a pane of glass, and the fog scatters what a mirror sends.
  const CasterPictures of{PairView(in_fog(kFogs[1], R"(
    AttributeBegin Translate 0.9 2.2 0.5 Rotate 90 1 0 0
    AreaLightSource "diffuse" "rgb L" [20 18 16] "bool twosided" true
    Shape "disk" "float radius" 0.5 AttributeEnd
    AttributeBegin Material "thindielectric"
      Shape "bilinearmesh" "point3 P" [-1 1.5 -1.5  0 1.5 -1.5  -1 1.5 0.5  0 1.5 0.5]
    AttributeEnd
    Material "conductor" "float roughness" 0
    Shape "bilinearmesh" "point3 P" [-1.5 0.2 1  1 0.2 1  -1.5 1.8 1.4  1 1.8 1.4])"))};
  expect_equal(of.pictures(gathering_in_media(), 1, 16),
               of.pictures(camera_paths_only(), 1000, 320), kFogs[1].name);
}

// Light paths that are connected to the camera find the caustics of a point light in fog, too.
TEST_P(MediumPhotonsIn, FindCausticsOfAPointLight) {
  const CasterPictures of{PairView(in_fog(GetParam(), R"(
    LightSource "point" "rgb I" [9 8 7] "point3 from" [0.5 2.6 0.2]
    Material "dielectric" "spectrum eta" "glass-SF11"
    AttributeBegin Translate 0.2 1.5 0 Shape "sphere" "float radius" 0.5 AttributeEnd
    Material "conductor" "bool remaproughness" false "float roughness" 0.02
    Shape "bilinearmesh" "point3 P" [-1.5 0.2 1  1 0.2 1  -1.5 1.8 1.4  1 1.8 1.4])"))};
  const PairTechniques connecting{.light_paths = 16384, .connects = true};
  expect_equal(of.pictures(gathering_in_media(), 1, 32), of.pictures(connecting, 1000, 32),
               GetParam().name);
}

// Only photons and light paths find these caustics, so no trial has a say in whether there are
// photons.
TEST(MixedInFog, HasTheCausticsOfAPointLight) {
  const auto scene = scene_from_text(R"(
    LookAt 0 1.4 -6  0 1.3 0  0 1 0
    Camera "perspective" "float fov" 36
    Film "rgb" "integer xresolution" 60 "integer yresolution" 40
    PixelFilter "box"
    WorldBegin
  )" + in_fog(kFogs[0], R"(
    LightSource "point" "rgb I" [9 8 7] "point3 from" [0.5 2.6 0.2]
    Material "dielectric"
    AttributeBegin Translate 0.2 1.5 0 Shape "sphere" "float radius" 0.7 AttributeEnd
    Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]
    Shape "bilinearmesh" "point3 P" [-2 0 -2  2 0 -2  -2 0 2  2 0 2])"));
  const auto mean = [&](const char* plan, uint64_t seed) {
    return estimate_of(block_values(*scene, plan, {}, 16, 4, seed)[0]);
  };
  const Estimate mixed = mean("mixed", 1), bdpt = mean("bdpt", 100), path = mean("path", 200);
  for (const Estimate& e : {mixed, bdpt, path}) EXPECT_LT(e.error, max_error(0.01 * e.mean));
  // Merging loses some light at the edges of the fog.
  EXPECT_NEAR(mixed.mean, bdpt.mean, max_error(0.03 * bdpt.mean));
  EXPECT_LT(path.mean, 0.94 * mixed.mean);
}

// The wall's upper side is in fog, but it names empty space for it.
TEST(MediumPhotonsInEvenFog, AreThoseOfWalksWhereASurfaceNamesTheWrongMedium) {
  const CasterPictures of{PairView(in_fog(kFogs[0], std::string(kDiffuseBall) + R"(
    MediumInterface "" "fog"
    Material "diffuse" "rgb reflectance" [0.8 0.8 0.8]
    Shape "bilinearmesh" "point3 P" [-2 0.1 -1  2 0.1 -1  -2 0.1 2  2 0.1 2]
    ReverseOrientation
    Shape "bilinearmesh" "point3 P" [-2 0.2 -1  -1 0.2 -1  -2 1.2 2  -1 1.2 2])"))};
  expect_equal(of.pictures(gathering_in_media(), 1, 16),
               of.pictures(camera_paths_only(), 1000, 320), kFogs[0].name);
}

INSTANTIATE_TEST_SUITE_P(Fog, MediumPhotonsIn, ::testing::ValuesIn(kFogs),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
