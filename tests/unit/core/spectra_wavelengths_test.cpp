// Wavelength sampling: the density integrates to one, samples follow it, and dropping secondary
// wavelengths leaves estimates unbiased.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/spectrum.h"

namespace nephroid {
namespace {

/// Integral of visible_pdf over [a, b], by the midpoint rule with steps much shorter than those in
/// which the density is constant.
double visible_integral(double a, double b) {
  const int steps = static_cast<int>((b - a) * 50) + 1;
  const double h = (b - a) / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    sum += SampledWavelengths::visible_pdf(static_cast<float>(a + (i + 0.5) * h));
  return sum * h;
}

TEST(SampledWavelengths, VisibleDensityIntegratesToOne) {
  EXPECT_NEAR(visible_integral(360, 830), 1.0, 1e-5);
  EXPECT_EQ(SampledWavelengths::visible_pdf(359.9f), 0.0f);
  EXPECT_EQ(SampledWavelengths::visible_pdf(830.1f), 0.0f);
}

TEST(SampledWavelengths, VisibleSamplesCarryTheirDensity) {
  for (int k = 0; k < 1000; ++k) {
    const auto s = SampledWavelengths::sample_visible(static_cast<float>(k) / 1000.0f);
    for (int i = 0; i < kSpectrumSamples; ++i) {
      const float expected = SampledWavelengths::visible_pdf(s.lambda(i));
      ASSERT_GT(expected, 0.0f) << s.lambda(i);
      EXPECT_NEAR(s.pdf()[i] / expected, 1.0f, 2e-5f) << s.lambda(i);
    }
  }
}

TEST(SampledWavelengths, VisibleSamplesAreStratified) {
  const float u = 0.3f;
  const auto s = SampledWavelengths::sample_visible(u);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    const double expected = std::fmod(u + i / double(kSpectrumSamples), 1.0);
    EXPECT_NEAR(visible_integral(360, s.lambda(i)), expected, 1e-5) << i;
  }
}

/// Pearson's statistic of counts in 10 nm bins against the integral of visible_pdf.
template <class Draw>
double chi_square(const Draw& draw) {
  constexpr int kBins = 47, kDraws = 200000;
  std::array<int, kBins> counts{};
  std::mt19937 random(7);
  for (int n = 0; n < kDraws; ++n) {
    const float u = static_cast<float>(random() >> 8) * 0x1p-24f;
    const float lambda = draw(u);
    ++counts[std::min(static_cast<int>((lambda - 360.0f) / 10.0f), kBins - 1)];
  }
  double statistic = 0;
  for (int b = 0; b < kBins; ++b) {
    const double expected = kDraws * visible_integral(360 + 10 * b, 370 + 10 * b);
    statistic += (counts[b] - expected) * (counts[b] - expected) / expected;
  }
  return statistic;
}

TEST(SampledWavelengths, VisibleSamplesFollowTheDensity) {
  // The quantile 1 - 1e-5 of chi-square with 46 degrees of freedom.
  const double threshold = 97.0;
  EXPECT_LT(chi_square([](float u) { return SampledWavelengths::sample_visible(u).lambda(0); }),
            threshold);
  EXPECT_LT(chi_square([](float u) { return SampledWavelengths::sample_visible(u).lambda(5); }),
            threshold);
  // The test must be able to fail: a shift of two nanometres does.
  EXPECT_GT(chi_square([](float u) {
              return std::min(SampledWavelengths::sample_visible(u).lambda(0) + 2.0f, 830.0f);
            }),
            threshold);
}

TEST(SampledWavelengths, WavelengthsStayInRangeAtTheEndsOfU) {
  for (const float u : {0.0f, 0x1p-30f, kOneMinusEpsilon, 0.875f, 0.87499994f}) {
    const auto s = SampledWavelengths::sample_visible(u);
    for (int i = 0; i < kSpectrumSamples; ++i) {
      EXPECT_GE(s.lambda(i), kLambdaMin);
      EXPECT_LE(s.lambda(i), kLambdaMax);
      EXPECT_GT(s.pdf()[i], 0.0f);
    }
  }
}

TEST(SampledWavelengths, TerminatingTwiceIsTerminatingOnce) {
  auto s = SampledWavelengths::sample_visible(0.4f);
  const float hero = s.pdf()[0];
  EXPECT_FALSE(s.secondary_terminated());
  s.terminate_secondary();
  s.terminate_secondary();
  EXPECT_TRUE(s.secondary_terminated());
  EXPECT_FLOAT_EQ(s.pdf()[0], hero / kSpectrumSamples);
  for (int i = 1; i < kSpectrumSamples; ++i) EXPECT_EQ(s.pdf()[i], 0.0f);
}

TEST(SampledWavelengths, AnyOneCanBeTheHero) {
  const auto all = SampledWavelengths::sample_visible(0.4f);
  EXPECT_EQ(all.left(), kAllWavelengths);
  EXPECT_EQ(all.hero(), all.lambda(0));
  for (int number = 0; number < kSpectrumSamples; ++number) {
    SampledWavelengths s = all.with_hero(number);
    EXPECT_EQ(s.hero(), all.lambda(number));
    EXPECT_EQ(s.left(), kAllWavelengths);
    s.terminate_secondary();
    EXPECT_EQ(s.left(), number);
    for (int i = 0; i < kSpectrumSamples; ++i) {
      EXPECT_EQ(s.lambda(i), all.lambda(i));
      EXPECT_FLOAT_EQ(s.pdf()[i], i == number ? all.pdf()[i] / kSpectrumSamples : 0.0f);
    }
  }
}

TEST(SampledWavelengths, TerminatingKeepsTheMean) {
  // The integral of f over wavelength, estimated with all wavelengths and with the hero alone.
  const auto f = [](float lambda) { return 1.0f + std::sin(lambda * 0.02f); };
  const double exact = 470 + (std::cos(360 * 0.02) - std::cos(830 * 0.02)) / 0.02;
  double all = 0, hero = 0;
  const int n = 20000;
  for (int k = 0; k < n; ++k) {
    auto s = SampledWavelengths::sample_visible((static_cast<float>(k) + 0.5f) / n);
    const SampledSpectrum values = s.lambdas().map(f);
    all += safe_div(values, s.pdf()).average();
    s.terminate_secondary();
    hero += safe_div(values, s.pdf()).average();
  }
  // Midpoint rule over u: the integrand is steep only near 830 nm.
  EXPECT_NEAR(all / n, exact, 1e-4 * exact);
  EXPECT_NEAR(hero / n, exact, 1e-4 * exact);
}

}  // namespace
}  // namespace nephroid
