// Estimators that choose lights by what a survey has learned find the picture of those that choose
// by importance alone.
#include <gtest/gtest.h>

#include "rendering.h"
#include "transport/light_survey.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr int kLearnedLightSeeds = 16, kLearnedLightBlocks = 3;

/// Five lamps of all kinds and a sky. A wall with a gap hides some of them from each place, and a
/// ball of glass throws caustics.
std::unique_ptr<Scene> two_halves() {
  return scene_from_text(R"(
    LookAt 0 5 -4  0 0.3 0  0 1 0 Camera "perspective" "float fov" 45
    Film "rgb" "integer xresolution" 24 "integer yresolution" 24
    PixelFilter "box"
    WorldBegin
    LightSource "infinite" "rgb L" [0.1 0.12 0.15]
    LightSource "point" "rgb I" [3 2 1] "point3 from" [-1.5 1 0.5]
    LightSource "point" "rgb I" [1 2 3] "point3 from" [1.5 1 0.5]
    LightSource "spot" "rgb I" [9 8 7] "point3 from" [1 2 -1] "point3 to" [1 0 1]
      "float coneangle" 25
    AttributeBegin AreaLightSource "diffuse" "rgb L" [20 18 16] Translate -1.6 0.6 1.2
      Shape "sphere" "float radius" 0.15 AttributeEnd
    AttributeBegin AreaLightSource "diffuse" "rgb L" [30 28 26] Translate 1.6 1.5 1.2
      Shape "sphere" "float radius" 0.15 AttributeEnd
    Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
    Shape "bilinearmesh" "point3 P" [-2 0 -2  2 0 -2  -2 0 2  2 0 2]
    Shape "bilinearmesh" "point3 P" [0 0 -2  0 1.6 -2  0 0 0.2  0 1.6 0.2]
    Shape "bilinearmesh" "point3 P" [0 0 0.8  0 1.6 0.8  0 0 2  0 1.6 2]
    Material "dielectric"
    AttributeBegin Translate -0.9 0.4 -0.6 Shape "sphere" "float radius" 0.4 AttributeEnd)");
}

class LearnedLights : public ::testing::TestWithParam<const char*> {};

TEST_P(LearnedLights, GiveThePictureOfUnlearnedOnes) {
  IntegratorOptions options;
  options.max_depth = 4;
  const auto plain = two_halves(), learned = two_halves();
  learned->light_sampler->learn(survey_lights(*learned));
  // The caustic of the point lights is out of reach of `path`.
  const std::string reference = std::string(GetParam()) == "path" ? "path" : "bdpt";
  const SeedValues expected =
      block_values(*plain, reference, options, kLearnedLightSeeds, 48, 100, kLearnedLightBlocks);
  const SeedValues found = unbiased_block_values(*learned, GetParam(), options, kLearnedLightSeeds,
                                                 24, 1, kLearnedLightBlocks);
  for (size_t i = 0; i < expected.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(expected[i]);
    const double error = std::hypot(a.error, b.error);
    std::printf("block %zu: off by %+.2f %%, standard error %.2f %%\n", i,
                100 * (a.mean / b.mean - 1), 100 * error / b.mean);
    EXPECT_NEAR(a.mean, b.mean, kT15 * error) << "block " << i;
    EXPECT_LT(error, max_error(0.03 * b.mean)) << "block " << i << " is too noisy to tell";
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, LearnedLights,
                         ::testing::Values("path", "mixed", "bdpt", "vcm", "bpm"));

}  // namespace
}  // namespace nephroid
