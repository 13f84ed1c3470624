// The report on a render's choices, from counts alone.
#include "session/report/choices_report.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

using Lines = std::vector<std::string>;

TEST(ChoicesReport, SaysNothingOfWhatWasNotDone) {
  EstimatorStatistics s;
  EXPECT_EQ(choices_report({s}, {s}, 3), Lines{});
  s.rays = 100;
  EXPECT_EQ(choices_report({s}, {s}, 3), Lines{}) << "all rays are of camera paths";
}

TEST(ChoicesReport, TellsWhereTheRaysWent) {
  EstimatorStatistics s;
  s.rays = 1000;
  s.light_rays = 250;
  s.learning_rays = 50;
  EXPECT_EQ(choices_report({s}, {s}, 1),
            Lines{"rays: 70 % of camera paths, 25 % of light paths, 5 % to learn"});
}

TEST(ChoicesReport, HasPhotonsLightPathsAndNotesOfAllEstimators) {
  EstimatorStatistics first, photons, light;
  first.radius_max_pixels = 1.5f;
  photons.photon_paths = 8000;
  photons.photon_paths_useful = 2000;
  photons.photons_stored = 2500;
  photons.radius_max_pixels = 1.5f;
  photons.radius_min_pixels = 0.75f;
  photons.notes = {"one"};
  light.light_paths = 4000;
  light.light_paths_useful = 400;
  light.splats = 3000000;
  light.notes = {"two"};
  EXPECT_EQ(
      choices_report({first, {}}, {photons, light}, 4),
      (Lines{
          "photons: 2 k paths per pass, 2.5 k photons kept in all, 25 % of paths kept any",
          "merge radius: 1.5 pixels in the first pass to 0.75 in the last",
          "light paths: 1 k per pass, 3 M connections to the camera in all, 10 % of paths had any",
          "note: one", "note: two"}));
  photons.photons_stay = true;
  EXPECT_EQ(choices_report({first}, {photons}, 4)[0],
            "photons: 8 k paths once, 2.5 k photons kept in all, 25 % of paths kept any");
}

TEST(TechniqueReport, NamesThoseThatCarryARouteLargestFirst) {
  EstimatorStatistics s;
  RouteTechniques caustic{"caustic", {}}, black{"black", {}};
  caustic.light[static_cast<size_t>(Technique::kSampleLight)] = 1;
  caustic.light[static_cast<size_t>(Technique::kMerge)] = 3;
  caustic.light[static_cast<size_t>(Technique::kMeetByMirrors)] = 1e-9;
  s.techniques = {caustic, black};
  EXPECT_EQ(
      technique_report({s}),
      Lines{
          "caustic, by technique: 75 % photon merging, 25 % next-event estimation (first passes)"});
}

TEST(ErrorReport, TellsRoutesThatAreSampledTogether) {
  FilmSettings settings;
  settings.width = settings.height = 1;
  FilmLayout layout = FilmLayout::of_routes({"a", "b", "c"});
  layout.groups = {0, 1, 0};
  layout.merges = {false, true};
  Film film(settings, layout);
  EXPECT_FALSE(error_report(film).has_value());
  const Rgb none[2] = {};
  for (const float v : {1.0f, 3.0f}) {
    film.add(0, 0, 0, none);
    film.add(1, 0, 0, std::vector<Rgb>{{v, v, v}});
    film.add_bias(1, std::vector<float>{0.2f});
    for (int g = 0; g < 2; ++g) film.add_estimates(g, 1);
  }
  EXPECT_EQ(error_report(film),
            "estimated error: 0 % noise of a and c, 49.9 % noise of b, 9.99 % bias of merging");
  Film one(settings, FilmLayout::of_routes({"a"}));
  for (int i = 0; i < 2; ++i) one.add(0, 0, 0, std::vector<Rgb>{{1, 1, 1}});
  one.add_estimates(0, 2);
  EXPECT_EQ(error_report(one), "estimated error: 0 % noise");
}

}  // namespace
}  // namespace nephroid
