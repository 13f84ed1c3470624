// Passes of path+photons find the same light for any length of camera paths, and whether photons or
// camera paths find caustics.
#include <gtest/gtest.h>

#include "pair_pass_view.h"
#include "transport/walk.h"

namespace nephroid {
namespace {

using namespace testing_support;

// Mean of all pixels over passes, its standard error, and the number of rays.
struct Mean {
  double value = 0, error = 0, rays = 0;
};
Mean mean_of(const PairView& view, const PairTechniques& techniques, uint32_t passes,
             const IntegratorOptions& options = {}) {
  Mean mean;
  double squares = 0;
  for (uint32_t i = 0; i < passes; ++i) {
    Film film = film_for(*view.scene, view.set);
    EstimatorStatistics statistics;
    render(view.pass_of(techniques, i, options),
           {.film = film, .samples = {view.one_path, view.no_walks}}, statistics);
    double sum = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 12; ++x) sum += static_cast<double>(film.value(x, y).g) / 96;
    mean.value += sum / passes;
    squares += sum * sum / passes;
    mean.rays += static_cast<double>(statistics.rays);
  }
  mean.error = std::sqrt((squares - mean.value * mean.value) / passes);
  return mean;
}

TEST(PairPass, FindsTheSameLightHoweverLongItsCameraPathsAre) {
  const PairView box(R"(
    Shape "bilinearmesh" "point3 P" [-4 4.2 -4  4 4.2 -4  -4 4.2 4  4 4.2 4]
    Shape "bilinearmesh" "point3 P" [-4 0 4  4 0 4  -4 5 4  4 5 4]
    AttributeBegin AreaLightSource "diffuse" "rgb L" [2 2 2]
    Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 5 -4  4 5 -4] AttributeEnd)");
  PairTechniques pass = camera_paths_only();
  const Mean one = mean_of(box, pass, 200);
  double rays = one.rays;
  for (const float window : {kCameraRouletteThreshold, kPatientRouletteThreshold}) {
    pass.roulette_threshold = window;
    const Mean longer = mean_of(box, pass, 200);
    EXPECT_NEAR(longer.value, one.value, 4 * std::hypot(longer.error, one.error)) << window;
    EXPECT_LT(longer.error, 0.02 * longer.value);
    EXPECT_GT(longer.rays, 1.05 * rays) << window;
    rays = longer.rays;
  }
}

TEST(PairPass, LeavesCausticsToWalksWhereThereAreNoPhotons) {
  const PairView view(R"(
    AttributeBegin AreaLightSource "diffuse" "rgb L" [2 2 2] Translate 0 9 0
    Shape "sphere" "float radius" 3 AttributeEnd
    Material "dielectric" Translate 0 0.8 0 Shape "sphere" "float radius" 0.6)");
  PairTechniques pass = camera_paths_only();
  const Mean walks = mean_of(view, pass, 200);
  pass.light_paths = 1 << 14;
  // Pixels are large here: the default radius would bias merging by five percent.
  IntegratorOptions options;
  options.radius = 0.2f;
  const Mean both = mean_of(view, pass, 100, options);
  EXPECT_NEAR(walks.value, both.value, 4 * std::hypot(walks.error, both.error));
  EXPECT_LT(walks.error, 0.02 * walks.value);
}

}  // namespace
}  // namespace nephroid
