// The reduced photon map: photons stored by `doidge2012` and by full photon mapping, in a Cornell
// box with a glass sphere. Doidge et al. 2012 report about a tenth.
#include <gtest/gtest.h>

#include "integrator/learning/guiding_options.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

const char* const kBox = R"(
  LookAt 0 1 -3.4  0 1 0  0 1 0
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 16 "integer yresolution" 16
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [17 12 4]
    Shape "bilinearmesh" "point3 P" [-0.25 1.98 -0.25  0.25 1.98 -0.25  -0.25 1.98 0.25  0.25 1.98 0.25]
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.73 0.71 0.68]
  Shape "bilinearmesh" "point3 P" [-1 0 -1  1 0 -1  -1 0 1  1 0 1]
  Shape "bilinearmesh" "point3 P" [-1 2 -1  1 2 -1  -1 2 1  1 2 1]
  Shape "bilinearmesh" "point3 P" [-1 0 1  1 0 1  -1 2 1  1 2 1]
  Material "diffuse" "rgb reflectance" [0.63 0.06 0.05]
  Shape "bilinearmesh" "point3 P" [-1 0 -1  -1 0 1  -1 2 -1  -1 2 1]
  Material "diffuse" "rgb reflectance" [0.14 0.45 0.09]
  Shape "bilinearmesh" "point3 P" [1 0 -1  1 0 1  1 2 -1  1 2 1]
  Material "dielectric" "float eta" 1.5
  Translate 0.2 0.4 0 Shape "sphere" "float radius" 0.4
)";

uint64_t photons_stored(const Scene& scene, const std::string& plan) {
  IntegratorOptions options;
  options.photons_per_pass = 1 << 16;
  options.edit<GuidingOptions>().photons = false;  // unguided emission, as in the paper
  EstimatorSet set = make_estimators(plan_named(plan), options, scene);
  Film film = film_for(scene, set);
  uint64_t stored = 0;
  set.render_pass({1, 0}, scene, film);
  for (const EstimatorStatistics& s : set.statistics()) stored += s.photons_stored;
  return stored;
}

TEST(PhotonMemory, CausticPhotonsAreAFewOfAll) {
  const auto scene = scene_from_text(kBox);
  const uint64_t caustics = photons_stored(*scene, "doidge2012"),
                 all = photons_stored(*scene, "sppm");
  RecordProperty("doidge2012", static_cast<int>(caustics));
  RecordProperty("sppm", static_cast<int>(all));
  std::printf("photons stored: doidge2012 %llu, sppm %llu, share %.1f %%\n",
              static_cast<unsigned long long>(caustics), static_cast<unsigned long long>(all),
              100.0 * static_cast<double>(caustics) / static_cast<double>(all));
  EXPECT_GT(caustics, 0u);
  EXPECT_LE(static_cast<double>(caustics), 0.15 * static_cast<double>(all));
}

}  // namespace
}  // namespace nephroid
