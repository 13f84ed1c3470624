// Ratio tracking with majorants against quadrature: they agree only if majorants, lookups and ray
// clipping agree.
#include "unit/medium/medium_fixture.h"

namespace nephroid::testing_medium {
namespace {

/// Optical depth up to t_max at one wavelength, by the midpoint rule.
double optical_depth(const Medium& medium, const Ray& ray, float t_max, int k,
                     const SampledWavelengths& lambda) {
  float begin = kInfinity, end = 0;
  auto iterator = medium.majorants(ray, t_max, lambda);
  while (const auto s = iterator.next()) {
    begin = std::min(begin, s->t_min);
    end = s->t_max;
  }
  if (!(begin < end)) return 0;
  constexpr int kSteps = 4000;
  const double step = (double(end) - begin) / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float t = static_cast<float>(begin + (i + 0.5) * step);
    const MediumProperties m = medium.at(ray.o + ray.d * t, lambda);
    sum += (m.sigma_a[k] + m.sigma_s[k]) * step;
  }
  return sum;
}

/// One estimate by ratio tracking (Novak, Selle & Jarosz 2014).
double ratio_tracking(const Medium& medium, const Ray& ray, float t_max, int k,
                      const SampledWavelengths& lambda, TestRandom& random) {
  double transmittance = 1;
  auto iterator = medium.majorants(ray, t_max, lambda);
  while (const auto s = iterator.next()) {
    if (s->sigma_maj[k] == 0) continue;
    double t = s->t_min;
    for (;;) {
      t -= std::log(1 - double(random.next())) / s->sigma_maj[k];
      if (t >= s->t_max) break;
      const MediumProperties m = medium.at(ray.o + ray.d * static_cast<float>(t), lambda);
      transmittance *= 1 - (double(m.sigma_a[k]) + m.sigma_s[k]) / s->sigma_maj[k];
    }
  }
  return transmittance;
}

TEST(Transmittance, RatioTrackingIsTheIntegral) {
  for (const MediumCase& c : medium_cases()) {
    TestRandom random(21);
    int met = 0;
    for (int n = 0; met < 6 && n < 1000; ++n) {
      const Ray ray = random_ray(random, c.center, c.radius);
      const float t_max = n % 2 ? c.radius : 0.6f * c.radius;
      const int k = n % kSpectrumSamples;
      const auto lambda = test_wavelengths();
      const double depth = optical_depth(*c.medium, ray, t_max, k, lambda);
      if (depth < 0.05 || depth > 6) continue;
      ++met;
      testing_bsdf::Mean mean;
      for (int i = 0; i < 4000; ++i)
        mean.add(ratio_tracking(*c.medium, ray, t_max, k, lambda, random));
      EXPECT_NEAR(mean.mean(), std::exp(-depth), 4.5 * mean.error() + 1e-4) << c.name;
    }
    EXPECT_EQ(met, 6) << c.name;
  }
}

TEST(Transmittance, DoesNotDependOnTheUnitOfLength) {
  // The same medium at scales of 1e-4 and 1e4: its optical depth does not change.
  const std::string grid = "\"integer nx\" 3 \"integer ny\" 3 \"integer nz\" 3 \"float density\" " +
                           random_values(27, 6) + " \"float scale\" ";
  std::vector<double> depths;
  for (const float unit : {1e-4f, 1.0f, 1e4f}) {
    const MediumPtr m = medium_of(
        "uniformgrid", grid + std::to_string(1 / unit),
        "Scale " + std::to_string(unit) + " " + std::to_string(unit) + " " + std::to_string(unit));
    Ray ray{Vec3f(-1, -0.7f, -0.4f) * unit, normalize({1, 0.8f, 0.6f}), kInfinity, 0};
    depths.push_back(optical_depth(*m, ray, kInfinity, 0, test_wavelengths()));
  }
  EXPECT_GT(depths[1], 0.1);
  EXPECT_NEAR(depths[0], depths[1], 2e-4 * depths[1]);
  EXPECT_NEAR(depths[2], depths[1], 2e-4 * depths[1]);
}

}  // namespace
}  // namespace nephroid::testing_medium
