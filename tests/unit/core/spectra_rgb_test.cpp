// Rgb colours as spectra: reflectance, unbounded quantity, emission.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/color.h"
#include "core/spectra.h"

namespace nephroid {
namespace {

constexpr const char* kRgbSpaces[] = {"srgb", "dci-p3", "rec2020", "aces2065-1"};

Rgb emitted_colour(const RgbColorSpace& space, const Spectrum& s) {
  return space.from_xyz(spectrum_to_xyz(s));
}

TEST(RgbSpectra, WhiteAlbedoIsOneEverywhere) {
  for (const char* name : kRgbSpaces) {
    const SpectrumPtr s = rgb_albedo_spectrum(*RgbColorSpace::find(name), {1, 1, 1});
    EXPECT_TRUE(s->is_constant());
    for (const float lambda : {360.0f, 500.0f, 830.0f}) EXPECT_NEAR((*s)(lambda), 1.0f, 1e-3f);
  }
}

TEST(RgbSpectra, AlbedoStaysBetweenZeroAndOne) {
  for (const Rgb rgb : {Rgb{2, 0.5f, -1}, Rgb{1, 0, 0}, Rgb{0, 1, 1}, Rgb{3, 3, 3}}) {
    const SpectrumPtr s = rgb_albedo_spectrum(RgbColorSpace::srgb(), rgb);
    EXPECT_LE(s->max_value(), 1.0f);
    for (float lambda = 360; lambda <= 830; lambda += 1) {
      ASSERT_GE((*s)(lambda), 0.0f);
      ASSERT_LE((*s)(lambda), s->max_value());
    }
  }
}

TEST(RgbSpectra, UnboundedIsAScaledReflectanceOfHalfTheRange) {
  const RgbColorSpace& space = RgbColorSpace::srgb();
  const SpectrumPtr s = rgb_unbounded_spectrum(space, {50, 20, 5});
  const SigmoidPolynomial p = space.polynomial({0.5f, 0.2f, 0.05f});
  // Near zero the sigmoid loses digits: its terms are 1/2.
  EXPECT_NEAR((*s)(480), 100 * p(480), 100 * 1e-6f);
  EXPECT_NEAR(s->max_value(), 100 * p.max_value(), 100 * 1e-6f);
  EXPECT_FLOAT_EQ((*rgb_unbounded_spectrum(space, {7, 7, 7}))(600), 7.0f);
  EXPECT_EQ((*rgb_unbounded_spectrum(space, {0, 0, 0}))(600), 0.0f);
  EXPECT_EQ((*rgb_unbounded_spectrum(space, {-1, -2, -1}))(600), 0.0f);
}

TEST(RgbSpectra, EmissionHasItsColourInEverySpace) {
  for (const char* name : kRgbSpaces) {
    const RgbColorSpace& space = *RgbColorSpace::find(name);
    for (const Rgb rgb : {Rgb{1, 1, 1}, Rgb{17, 12, 6}, Rgb{0.02f, 0.03f, 0.025f}}) {
      const Rgb seen = emitted_colour(space, *rgb_illuminant_spectrum(space, rgb));
      // Interpolation error of the coefficients, as for reflectances, at twice the largest
      // component.
      const float tolerance = 1e-3f * 2 * std::max({rgb.r, rgb.g, rgb.b});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], rgb[c], tolerance) << name;
    }
  }
}

TEST(RgbSpectra, EmissionIsMeasuredByItsIlluminant) {
  const RgbColorSpace& space = RgbColorSpace::srgb();
  const SpectrumPtr red = rgb_illuminant_spectrum(space, {3, 0.1f, 0.1f});
  EXPECT_EQ(&red->photometric_reference(), &space.illuminant());
  EXPECT_EQ(spectrum_to_photometric(*red), spectrum_to_photometric(space.illuminant()));
  EXPECT_NEAR(spectrum_to_photometric(*red), kCieYIntegral, 1e-4f);
  // The colour itself is not preserved: red of 3 has a luminance of about 3 * 0.21.
  EXPECT_NEAR(spectrum_to_xyz(*red).y, 3 * 0.2126f + 0.1f * 0.7874f, 5e-3f);
}

TEST(RgbSpectra, EmissionSamplesAgree) {
  const auto lambda = SampledWavelengths::sample_visible(0.71f);
  const SpectrumPtr s = rgb_illuminant_spectrum(RgbColorSpace::srgb(), {2, 1, 0.5f});
  const SampledSpectrum values = s->sample(lambda);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    EXPECT_FLOAT_EQ(values[i], (*s)(lambda.lambda(i)));
    EXPECT_LE(values[i], s->max_value());
  }
}

}  // namespace
}  // namespace nephroid
