// Metropolis light transport finds the picture of path tracing for any pass size and chain length,
// and in a crop.
#include <gtest/gtest.h>

#include "integrator/metropolis/metropolis_options.h"
#include "metropolis_scene.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(Metropolis, PassesOfAnySizeFindTheSamePicture) {
  // Extreme settings: chains of one mutation, chains as long as the pass, large steps only.
  const auto scene = scene_from_text(kHead + kFilm + kWorld);
  IntegratorOptions options;
  options.max_depth = 4;
  const Estimate expected = mean_over_seeds(*scene, "path", options, 32, 64);
  struct Size {
    float mutations;
    int64_t chain_length;
    float large_step;
  };
  uint64_t seed = 100;
  for (const char* integrator : {"mlt", "pssmlt"})
    for (const Size& size : {Size{1, 1, 0.3f}, Size{8, 1 << 30, 0.02f}, Size{8, 16, 1.0f}}) {
      options.edit<MetropolisOptions>().mutations = size.mutations;
      options.edit<MetropolisOptions>().chain_length = size.chain_length;
      options.edit<MetropolisOptions>().large_step = size.large_step;
      const Estimate found = mean_over_seeds(*scene, integrator, options, 32, 8, seed += 100);
      const double error = std::hypot(found.error, expected.error);
      std::printf("%s, chains of %d: off by %+.2f %%, standard error %.2f %%\n", integrator,
                  static_cast<int>(size.chain_length), 100 * (found.mean / expected.mean - 1),
                  100 * error / expected.mean);
      EXPECT_NEAR(found.mean, expected.mean, kT31 * error)
          << integrator << ", chains of " << size.chain_length;
      EXPECT_LT(error, max_error(0.02 * expected.mean)) << "too noisy to tell";
    }
}

TEST(Metropolis, ACropIsAsBrightAsItsPartOfThePicture) {
  const auto whole = scene_from_text(kHead + kFilm + kWorld);
  const auto crop =
      scene_from_text(kHead + R"(Film "rgb" "integer xresolution" 12 "integer yresolution" 12
                 "integer pixelbounds" [4 8 4 8] )" +
                      kWorld);
  IntegratorOptions options;
  options.max_depth = 4;
  const SeedValues all = block_values(*whole, "path", options, 32, 32, 1, 3);
  const Estimate expected = estimate_of(all[4]);
  for (const char* integrator : {"mlt", "pssmlt"}) {
    const Estimate found = mean_over_seeds(*crop, integrator, options, 32, 16, 500);
    const double error = std::hypot(found.error, expected.error);
    EXPECT_NEAR(found.mean, expected.mean, kT31 * error) << integrator;
    EXPECT_LT(error, max_error(0.02 * expected.mean)) << "too noisy to tell";
  }
}

}  // namespace
}  // namespace nephroid
