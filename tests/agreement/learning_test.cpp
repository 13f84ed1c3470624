// Estimators that learn are unbiased when each render learns for itself. A picture that is better
// where its learning was lucky is biased, even if each guide is right. Many seeds on small films.
#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// A lamp, a glass ball with its caustic, and a wall that is lit by the floor.
constexpr char kLearningRoom[] = R"(
  LookAt 0 3 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 34
  Film "rgb" "integer xresolution" 4 "integer yresolution" 4
  PixelFilter "box"
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [3 2.7 2.4]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 1.5
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Shape "bilinearmesh" "point3 P" [-6 0 2  6 0 2  -6 4 2  6 4 2]
  Material "dielectric" Translate 0.2 0.7 0 Shape "sphere" "float radius" 0.6
)";
constexpr int kLearningSeeds = 256;
/// Quantile of the normal distribution at a two-sided level of 1e-5.
constexpr double kQuantile = 4.42;

struct LearningPlan {
  const char* name;
  Plan plan;
  uint32_t passes;  ///< the first pass, and at least two that have learned from it
};

IntegratorOptions options_of_all() {
  IntegratorOptions options;
  options.max_depth = 5;
  options.photons_per_pass = 1024;
  options.radius = 0.25f;
  return options;
}

/// Reference values of an estimator that does not learn, shared by all plans.
const SeedValues& right_values() {
  static const SeedValues values = block_values(*scene_from_text(kLearningRoom), "bdpt",
                                                options_of_all(), kLearningSeeds, 64, 1, 2);
  return values;
}

class Learning : public ::testing::TestWithParam<LearningPlan> {};

TEST_P(Learning, AnewForEachSeedHasNoBias) {
  const Plan& plan = GetParam().plan;
  const auto scene = scene_from_text(kLearningRoom);
  const IntegratorOptions options = options_of_all();
  const SeedValues found = values_over_seeds(kLearningSeeds, 1000, [&](uint64_t seed) {
    const PlanLearned learned = learn(*scene, plan, options, seed);
    const auto means = [&](float radius) {
      IntegratorOptions own = options;
      own.radius = radius;
      return block_means(render(*scene, plan, own, seed, GetParam().passes, 0, learned), 2);
    };
    std::vector<double> values = means(options.radius);
    if (!merges_photons(plan)) return values;
    // Extrapolate to a radius of zero, as unbiased_block_values does.
    const std::vector<double> smaller = means(options.radius * std::sqrt(0.5f));
    for (size_t i = 0; i < values.size(); ++i) values[i] = 2 * smaller[i] - values[i];
    return values;
  });
  const SeedValues& expected = right_values();
  for (size_t i = 0; i < found.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(expected[i]);
    const double error = std::hypot(a.error, b.error);
    std::printf("%s, block %zu: %.5f against %.5f, %+.2f standard errors of %.2f %%\n",
                GetParam().name, i, a.mean, b.mean, (a.mean - b.mean) / error,
                100 * error / b.mean);
    EXPECT_NEAR(a.mean, b.mean, kQuantile * error) << "block " << i;
    EXPECT_LT(error, max_error(0.02 * b.mean)) << "too noisy to tell";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Plans, Learning,
    ::testing::Values(LearningPlan{"mixed", "mixed", 6}, LearningPlan{"photons", "doidge2012", 8},
                      LearningPlan{"forecast", "forecast", 64}, LearningPlan{"mlt", "mlt", 64},
                      LearningPlan{"pointlights",
                                   plan_of({"all=C[SV]*[DG].*:pointlights", "rest=.*:path"}), 8}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
