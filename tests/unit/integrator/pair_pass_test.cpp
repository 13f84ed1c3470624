// Numbering and measurement of path+photons passes: each pass continues the sample sequence of the
// previous one, and its variance does not depend on memory.
#include "integrator/bidirectional/pair_pass.h"

#include <gtest/gtest.h>

#include "pair_pass_view.h"

namespace nephroid {
namespace {

using namespace testing_support;

// Light that depends only on position. Divided by uniform light of the same pass, which has the
// same colours, a pixel reveals where its paths hit.
struct Places {
  PairView uneven{R"(LightSource "point" "rgb I" [9 9 9] "point3 from" [1.5 1.2 0.7])"};
  PairView even{
      R"(LightSource "distant" "rgb L" [1 1 1] "point3 from" [0 1 0] "point3 to" [0 0 0])"};

  std::vector<double> of(uint32_t number, const SampleMap& map) const {
    const Film a = uneven.render(camera_paths_only(), number, map),
               b = even.render(camera_paths_only(), number, map);
    std::vector<double> values;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 12; ++x)
        values.push_back(static_cast<double>(a.value(x, y).g) /
                         static_cast<double>(b.value(x, y).g));
    return values;
  }
};

TEST(PairPass, GoesOnWithThePointsThatThePassBeforeHasLeft) {
  const Places places;
  constexpr uint32_t kPaths = 3, kPasses = 3;
  // One path per pass, in the order of the sequence.
  std::vector<std::vector<double>> single;
  for (uint32_t i = 0; i < kPaths * kPasses; ++i)
    single.push_back(places.of(i, places.even.one_path));
  for (uint32_t pass = 0; pass < kPasses; ++pass) {
    const std::vector<double> found = places.of(pass, SampleMap(places.even.bounds, kPaths));
    for (size_t pixel = 0; pixel < found.size(); ++pixel) {
      double sum = 0;
      for (uint32_t i = pass * kPaths; i < (pass + 1) * kPaths; ++i) sum += single[i][pixel];
      const double expected = sum / kPaths;
      ASSERT_NEAR(found[pixel], expected, 2e-3 * expected)
          << "pass " << pass << ", pixel " << pixel;
    }
  }
}

TEST(PairPass, TellsTheSameVarianceInBatches) {
  const PairView view(R"(
    LightSource "point" "rgb I" [9 9 9] "point3 from" [1.5 2.2 0.7]
    Material "dielectric" Translate 0 0.8 0 Shape "sphere" "float radius" 0.6)");
  PairTechniques pass = camera_paths_only();
  pass.light_paths = 100000;
  const SampleMap map(view.bounds, 4);
  const FilmFormat format = film_for(*view.scene, view.set).format();
  const auto variance = [&](int64_t memory) {
    IntegratorOptions options;
    options.memory_photons = memory;
    SampleVariance found(view.bounds);
    EstimatorStatistics statistics;
    run_trial(view.pass_of(pass, 0, options), format, {.paths = map}, found, statistics);
    EXPECT_GT(statistics.photons_stored, 100u);
    return found.by_tile();
  };
  const SampleVariance::ByTile whole = variance(1 << 20), batches = variance(1);
  double most = 0;
  for (size_t i = 0; i < whole.variance.size(); ++i) {
    EXPECT_NEAR(batches.variance[i], whole.variance[i], 1e-3 * whole.variance[i] + 1e-6);
    EXPECT_NEAR(batches.cost[i], whole.cost[i], 1e-3 * whole.cost[i]);
    most = std::max(most, whole.variance[i]);
  }
  EXPECT_GT(most, 0);
}

}  // namespace
}  // namespace nephroid
