// Guided camera paths, which learn from the first pass where light comes from, find the same
// picture as BSDF sampling. They are less noisy where light arrives through a small solid angle.
#include <gtest/gtest.h>

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/bidirectional/vertex_connection_merging.h"
#include "lit_patch.h"
#include "owned_routes.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

struct Ball {
  const char* name;
  const char* text;
};
const Ball kBalls[] = {
    {"diffuse", R"(Material "diffuse" "rgb reflectance" [0.3 0.5 0.7])"},
    {"coated", R"(Material "coateddiffuse" "rgb reflectance" [0.3 0.5 0.7] "float roughness" 0)"},
    {"rough_coat",
     R"(Material "coateddiffuse" "rgb reflectance" [0.3 0.5 0.7] "float roughness" 0.2)"},
    {"under_the_skin",
     R"(Material "subsurface" "rgb reflectance" [0.3 0.5 0.7] "rgb mfp" [0.1 0.05 0.03]
       "float roughness" 0.2)"},
    {"rough_glass", R"(Material "dielectric" "float eta" 1.5 "float roughness" 0.3)"},
    {"rough_metal",
     R"(Material "conductor" "rgb reflectance" [0.8 0.7 0.5] "float roughness" 0.3)"},
    {"glass", R"(Material "dielectric" "float eta" 1.5)"}};

class GuidedWalks : public ::testing::TestWithParam<Ball> {};

TEST_P(GuidedWalks, FindTheSamePictureWithLessNoise) {
  constexpr int kSeeds = 16, kAcross = 3;
  constexpr uint32_t kPasses = 16;
  const auto scene = scene_from_text(lit_patch(GetParam().text, 48));
  IntegratorOptions options;
  options.max_depth = 6;
  const std::vector<std::string> routes = {"all=.*:path+photons"};
  const EstimatorSet set = make_estimators(plan_of(routes), options, *scene);
  const OwnedRoutes owned = owned_routes(*scene, routes);
  const auto values = [&](bool guided, uint64_t first_seed) {
    return values_over_seeds(kSeeds, first_seed, [&](uint64_t s) {
      Film film = film_for(*scene, set);
      EstimatorStatistics statistics;
      const auto pass_of = [&](uint32_t number) {
        return PairPass{
            .key = {s, number},
            .seed = hash_combine(s, kPathAndPhotonsNumber),
            .scene = *scene,
            .owned = owned,
            .options = options,
            .techniques = {.light_paths = 0, .connects = false, .casters = ClassMask::kSpecular},
            .light_paths_vary = true};
      };
      const SampleMap first(film.bounds(), 16), one(film.bounds()), no_walks(film.bounds(), 0);
      auto found = measure(pass_of(0), film.format(), {first, no_walks},
                           {.measures_variance = false}, statistics);
      const RadianceGuide guide(std::move(found.records));
      EXPECT_TRUE(guide.guides()) << s;
      for (uint32_t i = 1; i <= kPasses; ++i)
        render(
            pass_of(15 + i),
            {.film = film, .samples = {one, no_walks}, .directions = guided ? guide : kNoRadiance},
            statistics);
      return block_means(film, kAcross);
    });
  };
  const SeedValues guided = values(true, 1), own = values(false, 1000);
  double light = 0, of_guided = 0, of_own = 0;
  for (size_t i = 0; i < guided.size(); ++i) {
    const Estimate a = estimate_of(guided[i]), b = estimate_of(own[i]);
    EXPECT_NEAR(a.mean, b.mean, kT15 * std::hypot(a.error, b.error)) << "block " << i;
    light += a.mean;
    of_guided += sqr(a.error);
    of_own += sqr(b.error);
  }
  std::printf("%s: standard error %.2f %%, variance without a guide over that with one: %.1f\n",
              GetParam().name, 100 * std::sqrt(of_guided) / light, of_own / of_guided);
  EXPECT_LT(std::sqrt(of_guided + of_own), max_error(0.02 * light)) << "too noisy to tell";
  if (!fixed_seeds()) return;
  EXPECT_GT(of_own / of_guided, 1.3);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GuidedWalks, ::testing::ValuesIn(kBalls),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
