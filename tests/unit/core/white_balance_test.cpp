// White balance: the chosen white light becomes white with the same luminance. If it is white
// already, nothing changes.
#include "core/white_balance.h"

#include <gtest/gtest.h>

#include "core/spectra.h"

namespace nephroid {
namespace {

TEST(WhiteBalance, TheLightItIsMadeForBecomesWhite) {
  for (const char* name : {"srgb", "rec2020", "aces2065-1"}) {
    const RgbColorSpace& space = *RgbColorSpace::find(name);
    for (const float kelvin : {2800.0f, 5000.0f, 6500.0f, 9000.0f}) {
      const Xyz light = spectrum_to_xyz(*daylight_spectrum(kelvin));
      const Rgb seen =
          white_balance(space, kelvin) * space.from_xyz({light.x / light.y, 1, light.z / light.y});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 1, 2e-5) << name << kelvin;
    }
  }
}

TEST(WhiteBalance, DaylightOfTheSpaceChangesLittle) {
  const ColorMatrix m = white_balance(RgbColorSpace::srgb(), 6504);
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(m[r][c], r == c ? 1 : 0, 5e-3);
  // Taking a warm light for white makes everything bluer.
  const Rgb grey = white_balance(RgbColorSpace::srgb(), 3500) * Rgb{0.5f, 0.5f, 0.5f};
  EXPECT_GT(grey.b, 1.3f * grey.r);
}

TEST(WhiteBalance, SensorAppliesItToEverySample) {
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  const RgbColorSpace& space = RgbColorSpace::srgb();
  const ColorMatrix m = white_balance(space, 4000);
  const SampledSpectrum light = lambda.lambdas() * 0.001f;
  const Rgb expected = m * sensor_weights(lambda, space, 2).apply(light);
  const Rgb found = sensor_weights(lambda, space, 2, m).apply(light);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-4f * std::abs(expected[c]));
}

}  // namespace
}  // namespace nephroid
