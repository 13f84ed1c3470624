// Learning of forecasts: photons that met casters on their way from lights, traced once for all
// passes.
#include <gtest/gtest.h>

#include "photon/forecast_map.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// A lamp above a floor, a mirror at its side, and a screen that may hide the lamp from the mirror.
// The mirror still sees the lit floor.
std::string mirror_and_lamp(bool hidden) {
  return std::string(R"(
  LookAt 0 3 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 30
  Film "rgb" "integer xresolution" 8 "integer yresolution" 8
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  )") +
         (hidden ? R"(
  Shape "bilinearmesh" "point3 P" [0.4 2.5 -6  4 2.5 -6  0.4 2.5 6  4 2.5 6])"
                 : "") +
         R"(
  Material "conductor" "float roughness" 0
  Shape "bilinearmesh" "point3 P" [3 0 -2  3 0 2  3 2 -2  3 2 2])";
}

EstimatorStatistics statistics_after(const Scene& scene, const std::vector<std::string>& routes,
                                     const std::vector<PassKey>& passes, int64_t photons = 8192) {
  IntegratorOptions options;
  options.photons_per_pass = photons;
  EstimatorSet set = make_estimators(plan_of(routes), options, scene);
  Film film = film_for(scene, set);
  for (const PassKey& pass : passes) set.render_pass(pass, scene, film);
  return set.statistics().front();
}

TEST(Forecast, IsLearnedOnce) {
  const auto scene = scene_from_text(mirror_and_lamp(false));
  const std::vector<std::string> routes = {"caustic=C.*[DG]S+L:forecast", "rest=.*:path"};
  const EstimatorStatistics first = statistics_after(*scene, routes, {{1, 0}});
  EXPECT_EQ(first.photon_paths, 8192u);
  EXPECT_GT(first.photons_stored, 100u);
  EXPECT_EQ(first.photon_paths_useful, first.photons_stored) << "no path lands twice";
  EXPECT_GE(first.photon_bytes, first.photons_stored * 6 * sizeof(float));
  ASSERT_EQ(first.notes.size(), 1u);
  EXPECT_NE(first.notes[0].find("forecast"), std::string::npos);
  const EstimatorStatistics later =
      statistics_after(*scene, routes, {{1, 0}, {1, 1}, {1, 2}, {1, 3}, {1, 4}});
  EXPECT_EQ(later.photon_paths, first.photon_paths);
  EXPECT_EQ(later.photons_stored, first.photons_stored);
}

// Notes on records describe existing records, and only those that change directions.
TEST(Forecast, SaysWhatItsSightsAreGoodFor) {
  const auto scene = scene_from_text(mirror_and_lamp(false));
  const std::vector<std::string> routes = {"all=.*:forecast"};
  const EstimatorStatistics few = statistics_after(*scene, routes, {{1, 0}}, 128);
  ASSERT_GT(few.photons_stored, 0u);
  ASSERT_LT(few.photons_stored, static_cast<uint64_t>(ForecastLobes::kMaxLobes));
  ASSERT_EQ(few.notes.size(), 1u);
  EXPECT_EQ(few.notes[0], std::to_string(few.photons_stored) +
                              " records of 128 photon paths are too few to forecast caustics; "
                              "they are path traced, as by the integrator path");
  const EstimatorStatistics other = statistics_after(*scene, routes, {{2, 0}});
  const EstimatorStatistics both = statistics_after(*scene, routes, {{1, 0}, {2, 0}});
  EXPECT_EQ(both.photons_stored, other.photons_stored) << "those of the first seed are gone";
  EXPECT_EQ(both.photon_paths, other.photon_paths);
  EXPECT_EQ(both.notes, other.notes);
}

// A lit floor seen in a mirror is no light that guides a path.
TEST(Forecast, KnowsOnlyWhatComesFromLights) {
  const auto scene = scene_from_text(mirror_and_lamp(true));
  EXPECT_GT(
      statistics_after(*scene, {"c=C[DG]@S[DG]L:photons", "rest=.*:path"}, {{1, 0}}).photons_stored,
      20u);
  const EstimatorStatistics s = statistics_after(*scene, {"all=.*:forecast"}, {{1, 0}});
  EXPECT_EQ(s.photons_stored, 0u);
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_NE(s.notes[0].find("none of 8192"), std::string::npos);
}

// Photons are traced in rounds until a map has enough records, or there are clearly almost none.
TEST(Forecast, LearnsInRoundsForAsLongAsSightsAreFew) {
  constexpr uint64_t kRound = 1 << 16, kEnough = 1 << 15, kMax = 16 * kRound;
  const std::vector<std::string> routes = {"caustic=C.*[DG]S+L:forecast", "rest=.*:path"};
  const auto many = scene_from_text(mirror_and_lamp(false));
  const EstimatorStatistics enough = statistics_after(*many, routes, {{1, 0}}, 0);
  EXPECT_EQ(enough.photon_paths % kRound, 0u);
  EXPECT_GT(enough.photon_paths, kRound) << "one round is not enough";
  EXPECT_LT(enough.photon_paths, kMax);
  EXPECT_GE(enough.photons_stored, kEnough);
  const double rounds = static_cast<double>(enough.photon_paths / kRound);
  EXPECT_LT(static_cast<double>(enough.photons_stored) * (rounds - 1) / rounds, kEnough)
      << "it stops as soon as it can";
  const auto none = scene_from_text(mirror_and_lamp(true));
  const EstimatorStatistics few = statistics_after(*none, routes, {{1, 0}}, 0);
  EXPECT_EQ(few.photon_paths, kMax);
  EXPECT_EQ(few.photons_stored, 0u);
}

}  // namespace
}  // namespace nephroid
