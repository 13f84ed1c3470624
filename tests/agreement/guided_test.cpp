// Guided photon emission finds the same picture as unguided emission, with less noise. So does
// path+photons, whose caustics are photons as well.
#include <gtest/gtest.h>

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/learning/guiding_options.h"
#include "integrator/learning/photon_guiding.h"
#include "integrator/photons/merge_radius.h"
#include "owned_routes.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

std::string view(const std::string& world) {
  return R"(
  LookAt 0 3.2 -2.2  0 0.2 0  0 1 0
  Camera "perspective" "float fov" 30
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  Film "rgb" "integer xresolution" 12 "integer yresolution" 12
  WorldBegin
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Material "dielectric" "float eta" 1.5
  )" + world;
}

// A glass ball that covers a small part of the lit area.
const char* const kGuidedBall =
    "AttributeBegin Translate 0 0.5 0 Shape \"sphere\" \"float radius\" 0.3 "
    "AttributeEnd\n";
struct Lights {
  const char* name;
  const char* text;
};
const Lights kLights[] = {
    {"point", R"(LightSource "point" "rgb I" [9 8 7] "point3 from" [1 3 0.5])"},
    {"sun_and_lamp",
     R"(LightSource "distant" "rgb L" [2 2 2] "point3 from" [1 3 0.5] "point3 to" [0 0 0]
       AttributeBegin Translate -2 3 1 Rotate 90 1 0 0
       AreaLightSource "diffuse" "rgb L" [20 18 16] "bool twosided" true
       Shape "disk" "float radius" 0.3 AttributeEnd)"},
    {"sky", R"(LightSource "infinite" "rgb L" [0.5 0.6 0.7])"},
};

double sum_of_squared_errors(const SeedValues& values) {
  double sum = 0;
  for (const auto& block : values) sum += sqr(estimate_of(block).error);
  return sum;
}

class Guided : public ::testing::TestWithParam<Lights> {};

// Caustics of the lights, and caustics of the lit floor, whose light arrives from everywhere.
TEST_P(Guided, PhotonsFindTheSameCausticWithLessNoise) {
  constexpr int kSeeds = 16, kAcross = 3, kBlocks = kAcross * kAcross;
  constexpr uint32_t kPasses = 32;
  const auto scene = scene_from_text(view(std::string(kGuidedBall) + GetParam().text));
  IntegratorOptions options;
  options.photons_per_pass = 2048;
  options.radius = 2;
  options.max_depth = 6;
  const Plan plan = plan_of(
      {"of-lights=C.*[DG]S+L:photons", "of-the-lit=C.*[DG]S+[DG]L:photons", "rest=.*:path"});
  struct Caustics {
    SeedValues of_lights, of_the_lit, all;
  };
  const auto caustics = [&](bool guided, uint64_t first_seed) {
    options.edit<GuidingOptions>().photons = guided;
    const SeedValues values = values_over_seeds(kSeeds, first_seed, [&](uint64_t seed) {
      std::vector<double> sums(3 * kBlocks, 0.0);
      EstimatorSet set = make_estimators(plan, options, *scene);
      Film film = film_for(*scene, set);
      for (uint32_t pass = 0; pass < kPasses; ++pass) set.render_pass({seed, pass}, *scene, film);
      for (int b = 0; b < kBlocks; ++b)
        for (int route = 0; route < 2; ++route)
          for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
              const auto light = static_cast<double>(
                  film.route_value(route, b % kAcross * 4 + x, b / kAcross * 4 + y).g);
              sums[static_cast<size_t>(route * kBlocks + b)] += light;
              sums[static_cast<size_t>(2 * kBlocks + b)] += light;
            }
      return sums;
    });
    const auto part = [&](int i) {
      return SeedValues(values.begin() + i * kBlocks, values.begin() + (i + 1) * kBlocks);
    };
    return Caustics{part(0), part(1), part(2)};
  };
  const Caustics guided = caustics(true, 1), own = caustics(false, 1000);
  double light = 0;
  for (size_t i = 0; i < kBlocks; ++i) {
    const Estimate a = estimate_of(guided.all[i]), b = estimate_of(own.all[i]);
    EXPECT_NEAR(a.mean, b.mean, kT15 * std::hypot(a.error, b.error)) << "block " << i;
    light += a.mean;
    const Estimate c = estimate_of(guided.of_the_lit[i]), d = estimate_of(own.of_the_lit[i]);
    EXPECT_NEAR(c.mean, d.mean, kT15 * std::hypot(c.error, d.error)) << "lit, block " << i;
  }
  const double error =
      std::sqrt(sum_of_squared_errors(guided.all) + sum_of_squared_errors(own.all));
  const double gain =
      sum_of_squared_errors(own.of_lights) / sum_of_squared_errors(guided.of_lights);
  const double of_the_lit =
      sum_of_squared_errors(own.of_the_lit) / sum_of_squared_errors(guided.of_the_lit);
  std::printf(
      "%s: standard error %.2f %%, variance without a guide over that with one: %.1f, of what the "
      "lights shine on: %.1f\n",
      GetParam().name, 100 * error / light, gain, of_the_lit);
  EXPECT_LT(error, max_error(0.05 * light)) << "too noisy to tell";
  if (!fixed_seeds()) return;
  EXPECT_GT(gain, 3);
  EXPECT_GT(of_the_lit, 1.5);
}

// MIS weights of camera paths and photons add up to one only if both know the guided emission.
TEST_P(Guided, WalksAndPhotonsTogetherFindTheSamePicture) {
  constexpr int kSeeds = 16, kAcross = 3;
  const auto scene = scene_from_text(view(std::string(kGuidedBall) + GetParam().text));
  IntegratorOptions options;
  options.radius = 1;
  options.max_depth = 6;
  const std::vector<std::string> routes = {"all=.*:path+photons"};
  const EstimatorSet set = make_estimators(plan_of(routes), options, *scene);
  const OwnedRoutes owned = owned_routes(*scene, routes);
  const auto values = [&](bool guided, uint64_t first_seed) {
    options.edit<GuidingOptions>().photons = guided;
    return values_over_seeds(kSeeds, first_seed, [&](uint64_t seed) {
      const auto means = [&](float radius) {
        IntegratorOptions own = options;
        own.radius = radius;
        Film film = film_for(*scene, set);
        const PhotonGuide guide =
            guide_photons_of(ClassMask::kSpecular, seed, *scene, film.format(), own).guide;
        EXPECT_EQ(guide.starts.empty(), !guided);
        const SampleMap map(film.bounds(), 8), no_walks(film.bounds(), 0);
        EstimatorStatistics statistics;
        for (uint32_t i = 0; i < 4; ++i)
          render({.key = {seed, i},
                  .seed = seed,
                  .scene = *scene,
                  .owned = owned,
                  .options = own,
                  .techniques = {.light_paths = 8192,
                                 .connects = false,
                                 .casters = ClassMask::kSpecular},
                  .radius_pixels = radius_of_pass(own, 0, i),
                  .emission = guide.starts,
                  .light_paths_vary = true},
                 {.film = film, .samples = {map, no_walks}}, statistics);
        return block_means(film, kAcross);
      };
      const std::vector<double> large = means(1);
      std::vector<double> result = means(std::sqrt(0.5f));
      for (size_t i = 0; i < large.size(); ++i) result[i] = 2 * result[i] - large[i];
      return result;
    });
  };
  const SeedValues guided = values(true, 1), own = values(false, 1000);
  for (size_t i = 0; i < own.size(); ++i) {
    const Estimate a = estimate_of(guided[i]), b = estimate_of(own[i]);
    const double error = std::hypot(a.error, b.error);
    std::printf("%s, block %zu: %.5f against %.5f, %+.2f standard errors of %.2f %%\n",
                GetParam().name, i, a.mean, b.mean, (a.mean - b.mean) / error,
                100 * error / b.mean);
    EXPECT_NEAR(a.mean, b.mean, kT15 * error) << "block " << i;
    EXPECT_LT(error, max_error(0.015 * b.mean)) << "too noisy to tell";
  }
}

INSTANTIATE_TEST_SUITE_P(Lights, Guided, ::testing::ValuesIn(kLights),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
