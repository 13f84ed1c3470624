// Where trials of the default integrator tell that light paths should be connected, its picture is
// still that of the others.
#include <gtest/gtest.h>

#include "lamp_in_a_tube.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(Trials, ThatConnectFindTheSamePicture) {
  constexpr int kSeeds = 16, kAcross = 2;
  const auto scene = scene_from_text(lamp_in_a_tube(
      R"(LookAt 0 1.4 -4  0 1.7 3  0 1 0 Camera "perspective" "float fov" 16)", 16));  // the wall
  IntegratorOptions options;
  options.max_depth = 6;
  const Preset preset = make_preset(plan_named("mixed"), options, *scene);
  Film film = film_for(*scene, preset);
  std::string notes;
  for (const auto& e : preset.estimators) {
    e->render_pass({1, 0}, *scene, film);
    for (const std::string& note : e->statistics().notes) notes += note + "\n";
  }
  EXPECT_NE(notes.find("connected and merged everywhere"), std::string::npos) << notes;
  const SeedValues reference = block_values(*scene, "bdpt", options, kSeeds, 32, 1, kAcross);
  const SeedValues found =
      unbiased_block_values(*scene, "mixed", options, kSeeds, 16, 100, kAcross);
  for (size_t i = 0; i < reference.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(reference[i]);
    const double error = std::hypot(a.error, b.error);
    std::printf("block %zu: off by %+.2f %%, standard error %.2f %%\n", i,
                100 * (a.mean / b.mean - 1), 100 * error / b.mean);
    EXPECT_NEAR(a.mean, b.mean, kT15 * error) << "block " << i;
    EXPECT_LT(error, 0.02 * b.mean) << "block " << i << " is too noisy to tell";
  }
}

}  // namespace
}  // namespace nephroid
