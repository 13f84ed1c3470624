// Random numbers of eye paths and light paths are independent: with a single seed, a pixel keeps
// converging over many passes. Every connection here depends on the light path's random choice.
#include <gtest/gtest.h>

#include "integrator/bidirectional/technique_choice.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// The camera looks straight down. Each pixel has a white board on its left half and a black floor
// on its right half. A red and a blue spot light shine on the ceiling only.
std::string stripes() {
  std::string text = R"(
    LookAt 0 1 0  0 0 0  0 0 1
    Camera "orthographic" "float screenwindow" [-1 1 -1 1]
    Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    PixelFilter "box"
    WorldBegin
    LightSource "spot" "rgb I" [9 0 0] "point3 from" [-0.5 1.5 0] "point3 to" [-0.7 3 0]
      "float coneangle" 60 "float conedeltaangle" 1
    LightSource "spot" "rgb I" [0 0 9] "point3 from" [0.5 1.5 0] "point3 to" [0.7 3 0]
      "float coneangle" 60 "float conedeltaangle" 1
    Material "diffuse" "rgb reflectance" [0.8 0.8 0.8]
    Shape "bilinearmesh" "point3 P" [-4 3 -4  4 3 -4  -4 3 4  4 3 4]
    Material "diffuse" "rgb reflectance" [0 0 0]
    Shape "bilinearmesh" "point3 P" [-4 -0.01 -4  4 -0.01 -4  -4 -0.01 4  4 -0.01 4]
    Material "diffuse" "rgb reflectance" [0.8 0.8 0.8]
  )";
  for (const char* x : {"-1", "-0.5", "0", "0.5"})
    text += std::string("AttributeBegin Translate ") + x +
            " 0 0 Shape \"bilinearmesh\" \"point3 P\" [0 0 -1  0.25 0 -1  0 0 1  0.25 0 1] "
            "AttributeEnd ";
  return text;
}

/// Red and blue values of all pixels.
std::vector<double> colors_of(const Film& film) {
  std::vector<double> colors;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      colors.push_back(film.value(x, y).r);
      colors.push_back(film.value(x, y).b);
    }
  return colors;
}

class PairNumbers : public ::testing::TestWithParam<const char*> {};

TEST_P(PairNumbers, OneSeedConverges) {
  const auto scene = scene_from_text(stripes());
  const RoutePlan plan = plan_of({std::string("all=.*:") + GetParam()});
  IntegratorOptions options;
  options.max_depth = 2;
  options.photons_per_pass = 1;
  options.radius = 1e-3f;
  // The only technique whose contribution the light path alone decides.
  options.edit<TechniqueChoice>() = {2, 2, true, false};
  constexpr uint32_t kPasses = 4096, kSeeds = 128, kSome = 16;
  // Mean and variance of one pass, from independent seeds.
  std::vector<double> mean(32, 0.0), square(32, 0.0);
  const SeedValues few = values_over_seeds(kSeeds, 100, [&](uint64_t seed) {
    return colors_of(render(*scene, plan, options, seed, kSome));
  });
  for (size_t i = 0; i < few.size(); ++i)
    for (const double value : few[i]) {
      mean[i] += value / kSeeds;
      square[i] += value * value / kSeeds;
    }
  const std::vector<double> many = colors_of(render(*scene, plan, options, 1, kPasses));
  double error = 0, all = 0, expected = 0;
  for (size_t i = 0; i < many.size(); ++i) {
    const double variance = square[i] - mean[i] * mean[i];
    error += sqr(many[i] - mean[i]);
    expected += variance / kSeeds + variance * kSome / kPasses;
    all += sqr(mean[i]);
  }
  std::printf("%s: error %g, of independent numbers %g, picture %g\n", GetParam(), std::sqrt(error),
              std::sqrt(expected), std::sqrt(all));
  // Almost surely below 4, as there are many pixels. Above 50 if a pixel's error did not shrink.
  EXPECT_LT(error, 4 * expected);
  EXPECT_LT(expected, 0.02 * all);
}

INSTANTIATE_TEST_SUITE_P(Estimators, PairNumbers, ::testing::Values("bdpt", "vcm"));

}  // namespace
}  // namespace nephroid
