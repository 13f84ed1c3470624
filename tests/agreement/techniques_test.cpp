// The light that estimators report by technique adds up to the light on the film.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "integrator/path/path_options.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr char kCountedScene[] = R"(
  LookAt 0 2.5 -4  0 0.5 0  0 1 0
  Camera "perspective" "float fov" 45
  Film "rgb" "integer xresolution" 16 "integer yresolution" 12
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [9 8 7]
    Translate 0 3 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.6
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  Material "dielectric" "float eta" 1.5
  AttributeBegin Translate 0 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
)";

double light_of(const Film& film, size_t route) {
  double sum = 0;
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const Rgb v = film.route_value(static_cast<int>(route), x, y);
      sum += static_cast<double>(v.r) + v.g + v.b;
    }
  return sum;
}

class Techniques : public ::testing::TestWithParam<std::string> {};

void expect_sums(const std::string& plan, const IntegratorOptions& options) {
  const auto scene = scene_from_text(kCountedScene);
  EstimatorSet set = make_estimators(Plan(plan), options, *scene);
  Film film = film_for(*scene, set);
  constexpr uint32_t kPasses = 3;
  for (uint32_t pass = 0; pass < kPasses; ++pass) set.render_pass({5, pass}, *scene, film);
  int told = 0;
  for (const EstimatorStatistics& s : set.statistics())
    for (const RouteTechniques& r : s.techniques) {
      const auto& names = film.layout().routes;
      const auto route =
          static_cast<size_t>(std::find(names.begin(), names.end(), r.route) - names.begin());
      ASSERT_LT(route, names.size());
      double sum = 0;
      for (const double light : r.light) {
        EXPECT_GE(light, -1e-6) << r.route;
        sum += light;
      }
      const double expected = kPasses * light_of(film, route);
      EXPECT_NEAR(sum, expected, 1e-4 * expected) << r.route;
      told += sum > 0;
    }
  EXPECT_GT(told, 0);
}

TEST_P(Techniques, AddUpToTheLightOfTheirRoutes) {
  IntegratorOptions options;
  options.photons_per_pass = 4000;
  expect_sums(GetParam(), options);
  // Photons in several batches. Those after the first are only merged.
  options.memory_photons = 1024;
  expect_sums(GetParam(), options);
}

// Over all routes, every technique of the estimator contributes.
TEST_P(Techniques, AreTheOnesThatTheEstimatorHas) {
  const auto scene = scene_from_text(kCountedScene);
  IntegratorOptions options;
  options.camera_samples_per_pass = 8;  // mixed then has walks for specular chains in every pixel
  EstimatorSet set = make_estimators(Plan(GetParam()), options, *scene);
  Film film = film_for(*scene, set);
  set.render_pass({5, 0}, *scene, film);
  TechniqueLight all{};
  const auto statistics = set.statistics();
  for (const RouteTechniques& r : statistics.back().techniques)
    for (size_t t = 0; t < kTechniqueCount; ++t) all[t] += r.light[t];
  const auto found = [&](Technique t) { return all[static_cast<size_t>(t)] > 1e-6; };
  const bool connects = GetParam() == "bdpt" || GetParam() == "vcm";
  EXPECT_TRUE(found(Technique::kSampleLight));
  EXPECT_EQ(found(Technique::kConnect), connects);
  EXPECT_EQ(found(Technique::kMeetCamera), connects);
  EXPECT_EQ(found(Technique::kMerge), GetParam() != "bdpt");
  EXPECT_EQ(found(Technique::kMeetByMirrors), GetParam() == "mixed");
}

TechniqueLight light_of_pass(const std::string& plan, const IntegratorOptions& options,
                             uint32_t pass) {
  const auto scene = scene_from_text(kCountedScene);
  EstimatorSet set = make_estimators(Plan(plan), options, *scene);
  Film film = film_for(*scene, set);
  set.render_pass({5, pass}, *scene, film);
  TechniqueLight all{};
  const auto statistics = set.statistics();
  for (const RouteTechniques& r : statistics.back().techniques)
    for (size_t t = 0; t < kTechniqueCount; ++t) all[t] += r.light[t];
  return all;
}

TEST_P(Techniques, AreTheSameForAnyNumberOfThreads) {
  std::vector<TechniqueLight> found;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    found.push_back(light_of_pass(GetParam(), {}, 0));
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST_P(Techniques, AreCountedInTheFirstPassesAlone) {
  EXPECT_NE(light_of_pass(GetParam(), {}, 7), TechniqueLight{});
  EXPECT_EQ(light_of_pass(GetParam(), {}, 8), TechniqueLight{});
}

TEST(TechniquesOfTrees, AreNotLightsMetByWalks) {
  // The lamp is seen reflected in the ball, by few paths.
  IntegratorOptions options;
  options.camera_samples_per_pass = 16;
  IntegratorOptions with_trees = options;
  with_trees.edit<PathOptions>().specular_trees = true;
  const auto by_mirrors = [](const TechniqueLight& all) {
    return all[static_cast<size_t>(Technique::kMeetByMirrors)];
  };
  EXPECT_GT(by_mirrors(light_of_pass("bdpt", with_trees, 0)), 0);
  EXPECT_EQ(by_mirrors(light_of_pass("bdpt", options, 0)), 0);
}

INSTANTIATE_TEST_SUITE_P(Estimators, Techniques, ::testing::Values("bdpt", "vcm", "bpm", "mixed"));

}  // namespace
}  // namespace nephroid
