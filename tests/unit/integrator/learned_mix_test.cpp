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

/// The plan that `mixed` learns for the scene in a film of this size.
MixPlan learned(int width, int height, const IntegratorOptions& options = {},
                const std::string& more = "") {
  std::string text = kFloor + more;
  text.replace(text.find("WIDTH"), 5, std::to_string(width));
  text.replace(text.find("HEIGHT"), 6, std::to_string(height));
  const auto scene = scene_from_text(text);
  EstimatorSet set = make_estimators(plan_named("mixed"), options, *scene);
  const FilmFormat format(film_settings(scene->film), set.layout);
  for (const auto& estimator : set.estimators) {
    const auto value = estimator->learn(*scene, format, 1, unwatched);
    if (const auto* mix = dynamic_cast<const LearnedMix*>(value.get())) return mix->plan();
  }
  ADD_FAILURE() << "mixed has no LearnedMix";
  return {};
}

double mean_paths(int width, int height) {
  return learned(width, height).samples.paths.mean();
}

TEST(LearnedMix, HasFewerCameraPathsInALargeFilm) {
  const double mean = mean_paths(200, 160);
  EXPECT_GT(mean, 1.6);
  EXPECT_LE(mean, SampleMap::kMaxMean);
  EXPECT_LE(mean_paths(2000, 1600), 1.5);
}

TEST(LearnedMix, HasTheLightPathsThatTheMeasuredPassAsksFor) {
  // A pane of glass over a part of the floor: many tiles there have some noise of photons, and few
  // tiles elsewhere have nearly all that of camera paths.
  const std::string glass = R"(
    Material "dielectric"
    Shape "trianglemesh" "point3 P" [-4 0.2 -3  -1 0.2 -3  -1 0.2 3  -4 0.2 3
                                     -4 0.6 -3  -1 0.6 -3  -1 0.6 3  -4 0.6 3]
      "integer indices" [0 1 2 0 2 3 4 6 5 4 7 6 0 5 1 0 4 5 1 6 2 1 5 6 2 7 3 2 6 7 3 4 0 3 7 4])";
  IntegratorOptions options;
  const MixPlan measured = learned(800, 640, options, glass);
  EXPECT_EQ(measured.techniques.casters, ClassMask::kSpecular);
  // Tiles of two paths each, as the user asks for, need not be measured: trials alone decide.
  options.camera_samples_per_pass = 2;
  const MixPlan even = learned(800, 640, options, glass);
  EXPECT_EQ(even.samples.paths.mean(), 2);
  const double of_trials = static_cast<double>(even.techniques.light_paths) / 2;
  EXPECT_GT(static_cast<double>(measured.techniques.light_paths),
            1.1 * of_trials * measured.samples.paths.mean());
  options = {};
  options.photons_per_pass = 12345;
  EXPECT_EQ(learned(800, 640, options, glass).techniques.light_paths, 12345);
}

}  // namespace
}  // namespace nephroid
