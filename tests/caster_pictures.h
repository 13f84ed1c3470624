// Pictures of a small scene by passes of path+photons with given techniques, without the bias of
// merging, and their comparison.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "pair_pass_view.h"

namespace nephroid::testing_support {

struct CasterPictures {
  static constexpr int kSeeds = 16, kBlocksAcross = 2;
  static constexpr float kRadius = 0.5f;  ///< pixels
  const PairView view;

  /// Block means of four passes, for independent seeds.
  SeedValues pictures(const PairTechniques& techniques, uint64_t first_seed, int samples) const {
    return values_over_seeds(kSeeds, first_seed, [&](uint64_t seed) {
      // Extrapolate to a radius of zero: the bias grows as the squared radius.
      std::vector<double> values = means(techniques, seed, samples, kRadius);
      if (techniques.light_paths == 0) return values;
      const std::vector<double> narrow =
          means(techniques, seed, samples, kRadius * std::sqrt(0.5f));
      for (size_t i = 0; i < values.size(); ++i) values[i] = 2 * narrow[i] - values[i];
      return values;
    });
  }

  std::vector<double> means(const PairTechniques& techniques, uint64_t seed, int samples,
                            float radius) const {
    IntegratorOptions options;
    options.max_depth = 8;
    Film film = film_for(*view.scene, view.set);
    const SampleMap map(film.bounds(), static_cast<uint16_t>(samples));
    EstimatorStatistics statistics;
    for (uint32_t i = 0; i < 4; ++i) {
      PairPass pass = view.pass_of(techniques, i, options);
      pass.key = {seed, i};
      pass.seed = seed;
      pass.radius_pixels = radius;
      render(pass, {.film = film, .samples = {map, view.no_walks}}, statistics);
    }
    return block_means(film, kBlocksAcross);
  }
};

inline void expect_equal(const SeedValues& found, const SeedValues& expected, const char* name) {
  for (size_t i = 0; i < expected.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(expected[i]);
    const double error = std::hypot(a.error, b.error);
    std::printf("%s, block %zu: %.5f against %.5f, %+.2f standard errors of %.2f %%\n", name, i,
                a.mean, b.mean, (a.mean - b.mean) / error, 100 * error / b.mean);
    EXPECT_NEAR(a.mean, b.mean, kT15 * error) << "block " << i;
    EXPECT_LT(error, max_error(0.02 * b.mean)) << "too noisy to tell";
  }
}

}  // namespace nephroid::testing_support
