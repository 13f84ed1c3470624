// The same bits for any number of threads and any order of passes, for all integrators and presets.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "determinism/scene_of_all_kinds.h"
#include "estimators.h"
#include "rendering.h"
#include "same_bits.h"
#include "session/light_layers.h"

namespace nephroid {
namespace {

using namespace testing_support;

// The features must not all be zero, or comparing them would prove nothing.
void expect_features(const Film& film) {
  double albedo = 0, depth = 0, normal = 0;
  const PixelBounds& b = film.bounds();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      albedo += static_cast<double>(film.albedo(x, y).g);
      depth += static_cast<double>(film.depth(x, y));
      normal += static_cast<double>(length(film.normal(x, y)));
    }
  const double pixels = static_cast<double>(b.area());
  EXPECT_GT(albedo, 0.1 * pixels);
  EXPECT_GT(depth, 3 * pixels);
  EXPECT_GT(normal, 0.5 * pixels);
}

class Determinism : public ::testing::TestWithParam<std::string> {};

TEST_P(Determinism, AnyNumberOfThreads) {
  const auto scene = scene_from_text(kScene);
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  RoutePlan plan = plan_named(GetParam());
  add_layers(LayerChoice::kBoth, *scene, &plan);
  std::vector<Film> films;
  for (const int threads : {1, 2, 3, 7}) {
    const ThreadLimit limit(threads);
    films.push_back(render(*scene, plan, options, 5, 3));
  }
  expect_same_bits(films[0], films[1], "1 and 2 threads");
  expect_same_bits(films[0], films[2], "1 and 3 threads");
  expect_same_bits(films[0], films[3], "1 and 7 threads");
  EXPECT_GT(picture_mean(films[0]), 0.0);
  expect_features(films[0]);
}

TEST_P(Determinism, AnyOrderOfIndependentPasses) {
  const auto scene = scene_from_text(kScene);
  IntegratorOptions options;
  options.photons_per_pass = 20000;
  EstimatorSet forwards = make_estimators(plan_named(GetParam()), options, *scene);
  for (const auto& e : forwards.estimators)
    if (!e->descriptor().capabilities.independent_passes) GTEST_SKIP() << "passes are a sequence";
  EstimatorSet backwards = make_estimators(plan_named(GetParam()), options, *scene);
  Film a = film_for(*scene, forwards), b = film_for(*scene, backwards);
  for (uint32_t pass = 0; pass < 4; ++pass) {
    forwards.render_pass({5, pass}, *scene, a);
    backwards.render_pass({5, 3 - pass}, *scene, b);
  }
  expect_same_bits(a, b, "passes forwards and backwards");
}

TEST_P(Determinism, BatchesOfPhotonsLoseNothing) {
  // A pass in many batches gathers the same photons: equal up to rounding of the sums.
  const auto scene = scene_from_text(kScene);
  IntegratorOptions whole, batched;
  whole.photons_per_pass = batched.photons_per_pass = 100000;
  batched.memory_photons = 1;  // the smallest possible batches
  const EstimatorSet set = make_estimators(plan_named(GetParam()), whole, *scene);
  for (const RouteGroup& group : set.routes->groups())
    if (is_one_of(group.estimator, {"photonmap"}))
      GTEST_SKIP() << "memory ends a map; it has no batches";
  const Film a = render(*scene, GetParam(), whole, 5, 1),
             b = render(*scene, GetParam(), batched, 5, 1);
  const PixelBounds& bounds = a.bounds();
  for (int y = bounds.y0; y < bounds.y1; ++y)
    for (int x = bounds.x0; x < bounds.x1; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(a.value(x, y)[c], b.value(x, y)[c], 1e-4 * (0.01 + std::abs(a.value(x, y)[c])));
}

INSTANTIATE_TEST_SUITE_P(AllRoutes, Determinism, ::testing::ValuesIn(plan_names()),
                         [](const auto& test) { return test_name(test.param); });

}  // namespace
}  // namespace nephroid
