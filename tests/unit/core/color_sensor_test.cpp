// The film sensor: the mean over wavelength samples of a light's response is the light's colour,
// with all wavelengths or with the hero alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/color.h"
#include "core/spectra.h"

namespace nephroid {
namespace {

/// Mean sensor response over `n` midpoints of u.
Rgb mean_response(const RgbColorSpace& space, const Spectrum& light, float scale, bool hero_only,
                  float imaging_ratio = 1) {
  const int n = 40000;
  double sum[3] = {};
  for (int k = 0; k < n; ++k) {
    auto lambda = SampledWavelengths::sample_visible((static_cast<float>(k) + 0.5f) / n);
    if (hero_only) lambda.terminate_secondary();
    const Rgb seen =
        sensor_weights(lambda, space, imaging_ratio).apply(light.sample(lambda) * scale);
    for (int c = 0; c < 3; ++c) sum[c] += seen[c];
  }
  return {static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n),
          static_cast<float>(sum[2] / n)};
}

TEST(Sensor, WhiteEmissionIsWhiteInEverySpace) {
  for (const char* name : {"srgb", "dci-p3", "rec2020", "aces2065-1"}) {
    const RgbColorSpace& space = *RgbColorSpace::find(name);
    const SpectrumPtr white = rgb_illuminant_spectrum(space, {1, 1, 1});
    const float scale = 1 / spectrum_to_photometric(space.illuminant());
    for (const bool hero_only : {false, true}) {
      const Rgb seen = mean_response(space, *white, scale, hero_only);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 1.0f, 1e-3f) << name << hero_only;
    }
  }
}

TEST(Sensor, ColourAndImagingRatioCarryOver) {
  const RgbColorSpace& space = RgbColorSpace::srgb();
  const Rgb rgb{4, 2, 1};
  const SpectrumPtr light = rgb_illuminant_spectrum(space, rgb);
  const float scale = 1 / spectrum_to_photometric(*light);
  const Rgb seen = mean_response(space, *light, scale, false, 2.5f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 2.5f * rgb[c], 2.5f * 8e-3f);
}

TEST(Sensor, OtherSpacesSeeTheSameLight) {
  // A light is defined in one space and seen in another: the matrices give the expected value.
  const RgbColorSpace &srgb = RgbColorSpace::srgb(), &wide = *RgbColorSpace::find("rec2020");
  const SpectrumPtr light = rgb_illuminant_spectrum(srgb, {0.8f, 0.3f, 0.2f});
  const float scale = 1 / spectrum_to_photometric(*light);
  const Rgb seen = mean_response(wide, *light, scale, false);
  const Rgb expected = wide.from_xyz(srgb.to_xyz({0.8f, 0.3f, 0.2f}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 2e-3f);
}

TEST(Sensor, DroppedWavelengthsWeighNothing) {
  auto lambda = SampledWavelengths::sample_visible(0.5f);
  const SensorWeights before = sensor_weights(lambda, RgbColorSpace::srgb(), 1);
  lambda.terminate_secondary();
  const SensorWeights after = sensor_weights(lambda, RgbColorSpace::srgb(), 1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_FLOAT_EQ(after.rgb[c][0], before.rgb[c][0] * kSpectrumSamples);
    for (int i = 1; i < kSpectrumSamples; ++i) EXPECT_EQ(after.rgb[c][i], 0.0f);
  }
}

/// How far the colour that eight wavelengths show of a light is from its mean over their offset in
/// the spectrum: rms of each channel, over the mean of the channel.
std::array<double, 3> tint(const Spectrum& light) {
  const int n = 4096;
  std::array<double, 3> sum{}, squares{};
  for (int k = 0; k < n; ++k) {
    // Offsets that differ by an eighth have the same wavelengths, in another order.
    const auto lambda =
        SampledWavelengths::sample_visible((static_cast<float>(k) + 0.5f) / (n * kSpectrumSamples));
    const Rgb seen = sensor_weights(lambda, RgbColorSpace::srgb(), 1).apply(light.sample(lambda));
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += seen[static_cast<int>(c)];
      squares[c] += double{seen[static_cast<int>(c)]} * seen[static_cast<int>(c)];
    }
  }
  std::array<double, 3> result{};
  for (size_t c = 0; c < 3; ++c) result[c] = std::sqrt(squares[c] * n / (sum[c] * sum[c]) - 1);
  return result;
}

TEST(Sensor, EightWavelengthsShowTheColourOfWhiteLight) {
  for (const char* name : {"stdillum-D65", "stdillum-D50", "stdillum-A"}) {
    const SpectrumPtr light = named_spectrum(name);
    ASSERT_TRUE(light) << name;
    for (const double channel : tint(*light)) EXPECT_LT(channel, 0.009) << name;
  }
  for (const double channel : tint(*constant_spectrum(1))) EXPECT_LT(channel, 0.009) << "flat";
}

}  // namespace
}  // namespace nephroid
