// What `mixed` learns of a film, beyond the values that balance_test.cpp computes by hand.
#include "integrator/mixed/learned_mix.h"

#include <gtest/gtest.h>

#include "determinism/scene_of_all_kinds.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

/// Camera paths per pixel and pass that `mixed` learns for the scene in a film of this size.
double mean_paths(int width, int height) {
  std::string text = kScene;
  const std::string size = "xresolution\" 24 \"integer yresolution\" 20";
  text.replace(text.find(size), size.size(),
               fmt::format("xresolution\" {} \"integer yresolution\" {}", width, height));
  const auto scene = scene_from_text(text);
  EstimatorSet set = make_estimators(plan_named("mixed"), {}, *scene);
  const FilmFormat format(film_settings(scene->film), set.layout);
  for (const auto& estimator : set.estimators) {
    const auto value = estimator->learn(*scene, format, 1, unwatched);
    if (const auto* mix = dynamic_cast<const LearnedMix*>(value.get()))
      return mix->plan().samples.paths.mean();
  }
  ADD_FAILURE() << "mixed has no LearnedMix";
  return 0;
}

TEST(LearnedMix, HasFewerCameraPathsInALargeFilm) {
  const double mean = mean_paths(200, 160);
  EXPECT_GT(mean, 1.6);
  EXPECT_LE(mean, SampleMap::kMaxMean);
  EXPECT_LE(mean_paths(2000, 1600), 1.5);
}

}  // namespace
}  // namespace nephroid
