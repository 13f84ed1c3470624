// The trials of the default integrator: where they choose to merge photons of all light, or share
// walks for specular chains out among tiles, the picture stays the same.
#include <gtest/gtest.h>

#include "lamp_in_a_tube.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

constexpr int kTrialSeeds = 16, kTrialAcross = 2;

/// Notes of the default integrator after its first two passes.
std::string notes_of(const Scene& scene, const IntegratorOptions& options) {
  EstimatorSet set = make_estimators(plan_named("mixed"), options, scene);
  Film film = film_for(scene, set);
  std::string notes;
  for (const uint32_t pass : {0u, 1u}) set.render_pass({1, pass}, scene, film);
  for (const EstimatorStatistics& s : set.statistics())
    for (const std::string& note : s.notes) notes += note + "\n";
  return notes;
}

void expect_same(const SeedValues& found, const SeedValues& reference, double noise_limit) {
  for (size_t i = 0; i < reference.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(reference[i]);
    const double error = std::hypot(a.error, b.error);
    std::printf("block %zu: off by %+.2f %%, standard error %.2f %%\n", i,
                100 * (a.mean / b.mean - 1), 100 * error / b.mean);
    EXPECT_NEAR(a.mean, b.mean, kT15 * error) << "block " << i;
    EXPECT_LT(error, max_error(noise_limit * b.mean)) << "block " << i << " is too noisy to tell";
  }
}

TEST(Trials, ThatMergeAllLightFindTheSamePicture) {
  const auto scene = scene_from_text(lamp_in_a_tube(
      R"(LookAt 0 1.4 -4  0 1.7 3  0 1 0 Camera "perspective" "float fov" 16)", 16));  // the wall
  IntegratorOptions options;
  options.max_depth = 6;
  const std::string notes = notes_of(*scene, options);
  EXPECT_NE(notes.find("photons render all indirect light"), std::string::npos) << notes;
  expect_same(unbiased_block_values(*scene, "mixed", options, kTrialSeeds, 24, 100, kTrialAcross),
              block_values(*scene, "bdpt", options, kTrialSeeds, 32, 1, kTrialAcross), 0.02);
}

// Some tiles have walks for specular chains, others leave their light to camera paths.
TEST(Trials, ThatShareGlintsOutFindTheSamePicture) {
  const auto scene = scene_from_text(R"(
    LookAt 0 1.5 -5  0 0.8 0  0 1 0 Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" 24 "integer yresolution" 24
    PixelFilter "box"
    WorldBegin
    LightSource "infinite" "rgb L" [0.1 0.12 0.15]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [90 80 70]
      Translate 1.5 3 -1 Shape "sphere" "float radius" 0.3
    AttributeEnd
    Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
    Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
    Material "dielectric" "float eta" 2
    AttributeBegin Translate -0.7 0.7 0 Shape "sphere" "float radius" 0.7 AttributeEnd
    AttributeBegin Translate 0.9 0.5 -0.5 Shape "sphere" "float radius" 0.5 AttributeEnd)");
  IntegratorOptions options;
  options.max_depth = 12;
  options.radius = 0.1f;  // makes the bias negligible
  const std::string notes = notes_of(*scene, options);
  EXPECT_NE(notes.find("smooth glass and mirrors per pixel and pass on average, 0 to "),
            std::string::npos)
      << notes;
  expect_same(block_values(*scene, "mixed", options, kTrialSeeds, 32, 100, kTrialAcross),
              block_values(*scene, "path", options, kTrialSeeds, 2048, 1, kTrialAcross), 0.02);
}

}  // namespace
}  // namespace nephroid
