// Constant, piecewise linear and black-body spectra, and integrals against the matching curves.
#include "core/spectra.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nephroid {
namespace {

void expect_sample_agrees(const Spectrum& s) {
  const auto lambda = SampledWavelengths::sample_visible(0.37f);
  const SampledSpectrum values = s.sample(lambda);
  for (int i = 0; i < kSpectrumSamples; ++i)
    EXPECT_FLOAT_EQ(values[i], s(lambda.lambda(i))) << lambda.lambda(i);
}

TEST(Spectra, ConstantIsConstant) {
  const SpectrumPtr s = constant_spectrum(0.7f);
  EXPECT_TRUE(s->is_constant());
  EXPECT_EQ((*s)(400), 0.7f);
  EXPECT_EQ(s->max_value(), 0.7f);
  expect_sample_agrees(*s);
}

TEST(Spectra, PiecewiseLinearInterpolatesAndEndsAtItsPoints) {
  const SpectrumPtr s =
      piecewise_linear_spectrum({300, 400, 400.25f, 400.5f, 700, 760}, {8, 1, 3, 2, 5, 0});
  EXPECT_FALSE(s->is_constant());
  EXPECT_FLOAT_EQ((*s)(400), 1.0f);
  EXPECT_FLOAT_EQ((*s)(400.125f), 2.0f);
  EXPECT_FLOAT_EQ((*s)(400.375f), 2.5f);
  EXPECT_FLOAT_EQ((*s)(550.25f), 3.5f);
  EXPECT_FLOAT_EQ((*s)(730), 2.5f);
  EXPECT_EQ((*s)(760.1f), 0.0f);
  EXPECT_FLOAT_EQ((*s)(350), 4.5f);
  EXPECT_FLOAT_EQ((*s)(380), 2.4f);
  EXPECT_EQ((*s)(299.9f), 0.0f);
  // 3.8 at 360 nm is visible, 8 at 300 nm is not.
  EXPECT_FLOAT_EQ(s->max_value(), 5.0f);
  expect_sample_agrees(*s);
}

TEST(Spectra, PiecewiseLinearWithFewOrRepeatedPoints) {
  EXPECT_EQ((*piecewise_linear_spectrum({}, {}))(500), 0.0f);
  const SpectrumPtr point = piecewise_linear_spectrum({500}, {2});
  EXPECT_EQ((*point)(500), 2.0f);
  EXPECT_EQ((*point)(499), 0.0f);
  const SpectrumPtr step = piecewise_linear_spectrum({400, 500, 500, 600}, {1, 1, 3, 3});
  EXPECT_EQ((*step)(499), 1.0f);
  EXPECT_EQ((*step)(500), 3.0f);
  EXPECT_EQ((*step)(501), 3.0f);
}

TEST(Spectra, BlackbodyPeaksWhereWienSaysWithValueOne) {
  for (const float kelvin : {3500.0f, 4500.0f, 6500.0f, 8000.0f}) {
    const SpectrumPtr s = blackbody_spectrum(kelvin);
    const float peak = 2.897771955e6f / kelvin;
    EXPECT_NEAR((*s)(peak), 1.0f, 1e-5f) << kelvin;
    EXPECT_LT((*s)(peak * 0.99f), (*s)(peak));
    EXPECT_LT((*s)(peak * 1.01f), (*s)(peak));
    EXPECT_EQ(s->max_value(), 1.0f);  // all these peaks are visible
    expect_sample_agrees(*s);
  }
}

TEST(Spectra, BlackbodyFollowsPlanck) {
  // The ratio of two wavelengths by Planck's law, in double precision.
  const double t = 2856, c2 = 1.438776877e7;  // nm K
  const auto planck = [=](double l) { return std::pow(l, -5) / std::expm1(c2 / (l * t)); };
  const SpectrumPtr s = blackbody_spectrum(static_cast<float>(t));
  EXPECT_NEAR((*s)(400) / (*s)(700), planck(400) / planck(700), 1e-6);
  EXPECT_NEAR(s->max_value(), planck(830) / planck(2.897771955e6 / t), 1e-5);
}

TEST(Spectra, BlackbodyIsFiniteAtAnyTemperature) {
  EXPECT_EQ((*blackbody_spectrum(0))(500), 0.0f);
  EXPECT_EQ((*blackbody_spectrum(-5))(500), 0.0f);
  for (const float kelvin : {1.0f, 50.0f, 300.0f, 1e5f, 1e7f}) {
    const float v = (*blackbody_spectrum(kelvin))(500);
    EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << kelvin << " " << v;
  }
}

TEST(Spectra, MatchingCurvesAreNormalisedByTheirYIntegral) {
  EXPECT_NEAR(spectrum_to_photometric(*constant_spectrum(1)), kCieYIntegral, 1e-4f);
  const Xyz white = spectrum_to_xyz(*constant_spectrum(1));
  EXPECT_NEAR(white.y, 1.0f, 1e-6f);
  // An equal-energy spectrum has equal tristimulus values, up to rounding in the CIE tables.
  EXPECT_NEAR(white.x, 1.0f, 1e-3f);
  EXPECT_NEAR(white.z, 1.0f, 1e-3f);
}

TEST(Spectra, MatchingCurvesAreLinearBetweenNanometres) {
  EXPECT_FLOAT_EQ(cie_xyz(360).x, 0.0001299f);
  EXPECT_FLOAT_EQ(cie_xyz(555).y, 1.0f);
  EXPECT_FLOAT_EQ(cie_xyz(600.5f).x, 0.5f * (cie_xyz(600).x + cie_xyz(601).x));
  EXPECT_GT(cie_xyz(830).y, 0.0f);
  EXPECT_EQ(cie_xyz(830.5f).y, 0.0f);
  EXPECT_EQ(cie_xyz(359.5f).y, 0.0f);
}

}  // namespace
}  // namespace nephroid
