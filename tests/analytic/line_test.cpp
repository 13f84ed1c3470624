// Density estimation on a line, by shared statistics [E1] and the memoryless radius [E2]. Errors
// fall with the powers of the number of passes that [E3] predicts, in regions of several widths.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

#include "analytic/line_experiment.h"
#include "photon/radius_schedule.h"

namespace nephroid {
namespace {

constexpr double kWidths[] = {0, 0.05, 0.3};
constexpr int kSeeds = 24;

/// Mean and root mean square of the errors over seeds, as [method][power of two].
struct Statistics {
  std::vector<uint32_t> passes;
  std::vector<double> mean[2], rms[2];
};

std::vector<Statistics> statistics_of(LineSettings settings,
                                      std::span<const double> widths = kWidths,
                                      int seeds = kSeeds) {
  std::vector<Statistics> result(widths.size());
  for (int seed = 0; seed < seeds; ++seed) {
    settings.seed = static_cast<uint64_t>(seed);
    const auto errors = line_errors(settings, widths);
    for (size_t r = 0; r < errors.size(); ++r) {
      Statistics& s = result[r];
      for (size_t m = 0; m < 2; ++m) {
        s.mean[m].resize(errors[r].size());
        s.rms[m].resize(errors[r].size());
      }
      s.passes.clear();
      for (size_t i = 0; i < errors[r].size(); ++i) {
        s.passes.push_back(errors[r][i].passes);
        const double e[2] = {errors[r][i].shared, errors[r][i].memoryless};
        for (size_t m = 0; m < 2; ++m) {
          s.mean[m][i] += e[m] / seeds;
          s.rms[m][i] += e[m] * e[m] / seeds;
        }
      }
    }
  }
  for (Statistics& s : result)
    for (std::vector<double>& rms : s.rms)
      for (double& value : rms) value = std::sqrt(value);
  return result;
}

/// Slope from passes[first] on.
double slope(const Statistics& s, const std::vector<double>& errors, size_t first) {
  return line_slope(std::span(s.passes).subspan(first), std::span(errors).subspan(first));
}

TEST(LineExperiment, MeansAreIntegrals) {
  for (const LineDensity density : {LineDensity::kFlat, LineDensity::kWave, LineDensity::kStep})
    for (const double center : {0.0, 0.3, 0.5, 0.95})
      for (const double width : {0.1, 0.5, 1.0}) {
        double sum = 0;
        constexpr int kSteps = 10000;
        for (int i = 0; i < kSteps; ++i)
          sum += line_density(density, center + width * ((i + 0.5) / kSteps - 0.5)) / kSteps;
        EXPECT_NEAR(line_mean(density, center, width), sum, 2e-4);
      }
  EXPECT_NEAR(line_mean(LineDensity::kWave, 0.2, 1), 1, 1e-12);
}

TEST(LineExperiment, SlopeOfAPower) {
  const uint32_t passes[] = {1, 2, 4, 8};
  const double errors[] = {3, -1.5, 0.75, -0.375};
  EXPECT_NEAR(line_slope(passes, errors), -1, 1e-12);
}

TEST(LineExperiment, ASeedIsAResult) {
  LineSettings settings;
  settings.photons_per_pass = 500;
  settings.passes = 16;
  const auto a = line_errors(settings, kWidths), b = line_errors(settings, kWidths);
  settings.seed = 1;
  const auto c = line_errors(settings, kWidths);
  for (size_t r = 0; r < a.size(); ++r) {
    ASSERT_EQ(a[r].size(), 5u);
    EXPECT_EQ(a[r][4].passes, 16u);
    EXPECT_EQ(a[r][4].shared, b[r][4].shared);
    EXPECT_EQ(a[r][4].memoryless, b[r][4].memoryless);
    EXPECT_NE(a[r][4].shared, c[r][4].shared);
  }
}

/// Exact standard deviations on a flat density after 1, 2, 4 ... passes, as [method][power of two].
/// A count is binomial, and both estimates are means over passes. [E1] uses the radii of the
/// expected photon counts.
std::array<std::vector<double>, 2> exact_noise(const LineSettings& settings) {
  SharedStatistics shared;
  shared.radius_squared = settings.radius;
  std::array<std::vector<double>, 2> result;
  double sums[2] = {0, 0};
  for (uint32_t pass = 0; pass < settings.passes; ++pass) {
    const double radii[2] = {shared.radius_squared,
                             settings.radius * memoryless_radius_squared(pass, settings.alpha)};
    for (size_t method : {0, 1}) {
      const double length = 2 * radii[method];
      sums[method] += (1 - length) / (length * settings.photons_per_pass);
      if (std::has_single_bit(pass + 1))
        result[method].push_back(std::sqrt(sums[method]) / (pass + 1));
    }
    shared.update(settings.photons_per_pass * 2 * radii[0], settings.alpha);
  }
  return result;
}

// A flat density has no bias, and a region's points do not matter: the error is noise whose square
// falls with passes^-alpha. With 400 seeds the logarithm of the rms has a standard error of
// 1/sqrt(800) = 0.035. A fit over six doublings has 0.035 / sqrt(17.5 * 0.48) = 0.012, or twice
// that, as the points are correlated. Slopes of the three alphas differ by 0.07 or more.
TEST(LineExperiment, NoiseFallsAsPredicted) {
  constexpr int kNoiseSeeds = 400;
  for (const double alpha : {0.5, 2.0 / 3.0, 0.8}) {
    LineSettings settings;
    settings.density = LineDensity::kFlat;
    settings.photons_per_pass = 2000;
    settings.passes = 512;
    settings.alpha = alpha;
    const auto found = statistics_of(settings, kWidths, kNoiseSeeds);
    const auto exact = exact_noise(settings);
    for (size_t r = 0; r < found.size(); ++r)
      for (const size_t method : {0, 1}) {
        const double fitted = slope(found[r], found[r].rms[method], 3);
        const double predicted = slope(found[r], exact[method], 3);
        std::printf(
            "flat, alpha %.2f, width %.2f, %s: slope %.3f, exact %.3f, power %.3f; "
            "noise %.5f against %.5f\n",
            alpha, kWidths[r], method == 0 ? "shared" : "memoryless", fitted, predicted, -alpha / 2,
            found[r].rms[method].back(), exact[method].back());
        EXPECT_NEAR(predicted, -alpha / 2, 0.04);
        EXPECT_NEAR(fitted, predicted, 0.05);
        // Four standard errors. [E1] also has noise in its radii.
        EXPECT_NEAR(found[r].rms[method].back() / exact[method].back(), 1, 0.15);
      }
  }
}

// At the crest of a wave the bias of a pass has a closed form, and its mean over passes tends to
// passes^(2 alpha - 2). After 16 passes the sum is not yet that power: the fit is compared with the
// exact sums, and both with the power within a wider limit.
TEST(LineExperiment, BiasFallsAsPredicted) {
  LineSettings settings;
  settings.density = LineDensity::kWave;
  settings.radius = 0.15;
  settings.photons_per_pass = 20000;
  settings.passes = 256;
  const double crest[] = {0};
  const auto found = statistics_of(settings, crest);
  // Mean densities within the radii of both methods. [E1] uses the radii of the expected photon
  // counts.
  SharedStatistics shared;
  shared.radius_squared = settings.radius;
  double sums[2] = {0, 0};
  std::vector<double> exact[2];
  for (uint32_t pass = 0; pass < settings.passes; ++pass) {
    const double radii[2] = {shared.radius_squared,
                             settings.radius * memoryless_radius_squared(pass, settings.alpha)};
    for (int method : {0, 1}) {
      sums[method] +=
          line_mean(LineDensity::kWave, 0, 2 * radii[method]) - line_density(LineDensity::kWave, 0);
      if (std::has_single_bit(pass + 1)) exact[method].push_back(sums[method] / (pass + 1));
    }
    shared.update(
        settings.photons_per_pass * 2 * radii[0] * line_mean(LineDensity::kWave, 0, 2 * radii[0]),
        settings.alpha);
  }
  for (const int method : {0, 1}) {
    const double fitted = slope(found[0], found[0].mean[method], 4);
    const double predicted = slope(found[0], exact[method], 4), power = 2 * settings.alpha - 2;
    const double last = found[0].mean[method].back(), bias = exact[method].back();
    std::printf("wave, %s: bias slope %.3f, exact sum %.3f, power %.3f; bias %.5f against %.5f\n",
                method == 0 ? "shared" : "memoryless", fitted, predicted, power, last, bias);
    EXPECT_NEAR(predicted, power, 0.12);
    EXPECT_NEAR(fitted, predicted, 0.05);
    EXPECT_NEAR(last, bias, 0.1 * std::abs(bias));
  }
}

// In regions of any width, and across a step, both estimates tend to the region's mean.
TEST(LineExperiment, ErrorsOfAllRegionsFallToZero) {
  for (const LineDensity density : {LineDensity::kWave, LineDensity::kStep}) {
    LineSettings settings;
    settings.density = density;
    settings.center = density == LineDensity::kStep ? 0.45 : 0.2;
    settings.photons_per_pass = 2000;
    settings.passes = 512;
    const auto found = statistics_of(settings);
    for (size_t r = 0; r < found.size(); ++r)
      for (const int method : {0, 1}) {
        const double fitted = slope(found[r], found[r].rms[method], 3);
        std::printf("width %.2f, %s: %.4f after 8 passes, %.4f after 512, slope %.3f\n", kWidths[r],
                    method == 0 ? "shared" : "memoryless", found[r].rms[method][3],
                    found[r].rms[method].back(), fitted);
        EXPECT_LT(found[r].rms[method].back(), 0.35 * found[r].rms[method][3]);
        EXPECT_GT(fitted,
                  -0.7);  // noise of the points within a region falls with 1/2
        EXPECT_LT(fitted, -0.25);
      }
  }
}

}  // namespace
}  // namespace nephroid
