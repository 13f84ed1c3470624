// [A6], the split of noise between camera and photons, against synthetic noise.
#include "integrator/mixed/trials.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace nephroid {
namespace {

constexpr int kSamples = 2;
const PixelBounds kBounds{0, 0, 256, 256};

/// Samples of two passes: `light(pass, pixel, sample)`. Each merges photons that would have
/// `photon_variance` if they were independent.
TrialNoise noise_of(const std::function<double(int, int, int)>& light, double photon_variance) {
  std::vector<SampleVariance> passes(2, SampleVariance(kBounds));
  for (int pass = 0; pass < 2; ++pass)
    for (int y = 0; y < kBounds.y1; ++y)
      for (int x = 0; x < kBounds.x1; ++x)
        for (int k = 0; k < kSamples; ++k) {
          passes[pass].add(x, y, light(pass, y * kBounds.x1 + x, k), 1);
          passes[pass].add_photons(x, y, photon_variance);
        }
  return split_noise(passes, SampleMap(kBounds), kSamples);
}

TEST(SplitNoise, TellsTheNoiseThatSamplesShare) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const auto& variances : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.5, 2.0}, {2.0, 0.5}}) {
    const double camera = variances.first, photons = variances.second;
    // All samples of a pixel and pass share their photons.
    std::vector<double> shared(2 * kBounds.area());
    for (double& v : shared) v = normal(random);
    // Stratified photons vary less than independent ones.
    const double independent = 1.5 * photons;
    const TrialNoise noise = noise_of(
        [&](int pass, int pixel, int) {
          return 10 + std::sqrt(photons) * shared[pass * kBounds.area() + pixel] +
                 std::sqrt(camera) * normal(random);
        },
        independent);
    EXPECT_NEAR(noise.light, 10, 0.05);
    EXPECT_NEAR(noise.variance_of_camera, camera, 0.03);
    EXPECT_NEAR(noise.variance_of_photons, photons, 0.05);
    // Over the mean of a tile plus a tenth of the picture's mean.
    EXPECT_NEAR(noise.of_camera, camera / 11, 0.003);
    EXPECT_NEAR(noise.of_photons, photons / 11, 0.005);
  }
}

/// Light with fireflies, each in a single sample of a pixel and far brighter than all else in its
/// tile. They make the difference of the two variances negative.
double light_with_fireflies(int pass, int pixel, int k) {
  return pixel % 1009 == 0 && pass == pixel / 1009 % 2 && k == 0 ? 1e4 : 1;
}

TEST(SplitNoise, DoesNotBlamePhotonsForFireflies) {
  const TrialNoise noise = noise_of(light_with_fireflies, 0);
  EXPECT_GT(noise.of_camera, 0);
  EXPECT_EQ(noise.of_photons, 0);
}

TEST(SplitNoise, SeesPhotonsBehindFireflies) {
  const double independent = 0.25;
  const TrialNoise noise = noise_of(light_with_fireflies, independent);
  EXPECT_GE(noise.variance_of_photons, 0.5 * independent * (1 - 1e-9));
  EXPECT_LE(noise.variance_of_photons, independent * (1 + 1e-9));
}

TEST(SplitNoise, LooksAtTheTilesThatHaveSamples) {
  std::vector<SampleVariance> passes(2, SampleVariance(kBounds));
  SampleMap tiles(kBounds, 0);
  tiles.counts()[0] = kSamples;
  for (SampleVariance& pass : passes)
    for (const double v : {2.0, 4.0}) pass.add(0, 0, v, 1);
  const TrialNoise noise = split_noise(passes, tiles, kSamples);
  EXPECT_DOUBLE_EQ(noise.light, 3);
  EXPECT_DOUBLE_EQ(noise.variance_of_camera, 2);
  EXPECT_DOUBLE_EQ(noise.variance_of_photons, 0);
}

TEST(Trials, PhotonsOfAllLightAreMergedFurther) {
  IntegratorOptions options;
  PairTechniques all, caustics;
  caustics.casters = ClassMask::kSpecular;
  EXPECT_FLOAT_EQ(first_radius_of_film(caustics, options, 0), 1.5f);
  EXPECT_FLOAT_EQ(first_radius_of_film(all, options, 0), 2);
  options.radius = 3;
  EXPECT_FLOAT_EQ(first_radius_of_film(all, options, 0), 3) << "unless the user says how far";
}

}  // namespace
}  // namespace nephroid
