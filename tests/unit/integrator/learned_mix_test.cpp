// What `mixed` learns of a film, beyond the values that balance_test.cpp computes by hand.
#include "integrator/mixed/learned_mix.h"

#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

/// A floor, half of it metal, under a sun and a lamp: its tiles differ in noise.
constexpr const char* kFloor = R"(
  LookAt 0 3 -6  0 0 0  0 1 0
  Camera "perspective" "float fov" 60
  Film "rgb" "integer xresolution" WIDTH "integer yresolution" HEIGHT
  WorldBegin
  LightSource "infinite" "rgb L" [0.02 0.02 0.02]
  LightSource "distant" "rgb L" [3 3 3] "point3 from" [0 5 -1] "point3 to" [0 0 0]
  Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
  Shape "bilinearmesh" "point3 P" [-9 0 -9  9 0 -9  -9 0 9  9 0 9]
  Material "conductor" "float roughness" 0.4
  Shape "bilinearmesh" "point3 P" [0 0.1 -9  9 0.1 -9  0 0.1 9  9 0.1 9]
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [40 40 40] "bool twosided" true
    Translate 2 1 0
    Shape "sphere" "float radius" 0.1
  AttributeEnd
)";

/// Camera paths per pixel and pass that `mixed` learns for the scene in a film of this size.
double mean_paths(int width, int height) {
  std::string text = kFloor;
  text.replace(text.find("WIDTH"), 5, std::to_string(width));
  text.replace(text.find("HEIGHT"), 6, std::to_string(height));
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
