// White furnace: where everything reflects all light and light comes from everywhere, nothing can be seen.
// Each integrator must find a radiance of exactly 1, up to the noise of its own estimate.
#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

struct FurnaceScene {
  const char* name;
  const char* objects;
};

const FurnaceScene kScenes[] = {
    {"diffuse", R"(Material "diffuse" "spectrum reflectance" [300 1 900 1]
                   Shape "sphere" "float radius" 1)"},
    {"glass", R"(Material "dielectric" Shape "sphere" "float radius" 1)"},
    {"rough_glass_over_diffuse",
     R"(Material "dielectric" "float roughness" 0.02 "bool remaproughness" false
        Shape "sphere" "float radius" 0.7
        Material "diffuse" "spectrum reflectance" [300 1 900 1]
        Translate 0 0 1.2 Shape "disk" "float radius" 6)"},
    {"glass_over_diffuse",
     R"(Material "dielectric" Shape "sphere" "float radius" 0.7
        Material "diffuse" "spectrum reflectance" [300 1 900 1]
        Translate 0 0 1.2 Shape "disk" "float radius" 6)"},
    {"thin_glass",
     R"(Material "thindielectric" Shape "disk" "float radius" 0.9
        Material "diffuse" "spectrum reflectance" [300 1 900 1]
        Translate 0 0 1.2 Shape "disk" "float radius" 6)"},
    {"mirror_beside_diffuse",
     R"(Material "diffuse" "spectrum reflectance" [300 1 900 1]
        Shape "sphere" "float radius" 0.6
        Material "interface" Shape "sphere" "float radius" 1.1)"},
};

class Furnace : public ::testing::TestWithParam<std::tuple<FurnaceScene, std::string>> {};

TEST_P(Furnace, RadianceIsOne) {
  const auto& [furnace, integrator] = GetParam();
  const auto scene = scene_from_text(std::string(R"(
    LookAt 0 0 -5  0 0 0  0 1 0
    Camera "perspective" "float fov" 30
    Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    PixelFilter "box"
    WorldBegin
    LightSource "infinite" "spectrum L" [300 1 900 1] "float scale" 1
    )") + furnace.objects);
  IntegratorOptions options;
  options.photons_per_pass = 4096;
  options.radius = 1.0f;
  const uint32_t passes = integrator == "path" ? 32 : 48;
  const Estimate e = mean_over_seeds(*scene, integrator, options, 16, passes);
  // The constant spectrum has Y = 1 but is not the white of sRGB: compare with the empty picture.
  const auto empty = scene_from_text(R"(
    Camera "perspective" Film "rgb" "integer xresolution" 8 "integer yresolution" 8
    PixelFilter "box"
    WorldBegin
    LightSource "infinite" "spectrum L" [300 1 900 1])");
  const Estimate expected = mean_over_seeds(*empty, integrator, options, 16, passes, 1000);
  EXPECT_NEAR(expected.mean, 1.0, 0.15);
  // Shared radii are smooth over edges of objects only in the limit: sppm may lose what lies beyond an edge.
  const double bias = integrator == "sppm" ? 0.02 * expected.mean : 0.0;
  EXPECT_NEAR(e.mean, expected.mean, kT15 * std::hypot(e.error, expected.error) + bias + 1e-4)
      << "standard error " << e.error;
}

INSTANTIATE_TEST_SUITE_P(
    AllIntegrators, Furnace,
    ::testing::Combine(::testing::ValuesIn(kScenes), ::testing::ValuesIn(integrator_names())),
    [](const auto& test) {
      return std::string(std::get<0>(test.param).name) + "_" + std::get<1>(test.param);
    });

}  // namespace
}  // namespace nephroid
