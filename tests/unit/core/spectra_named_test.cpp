// Measured spectra by pbrt-v4's names, against published constants of materials and lights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/spectra.h"

namespace nephroid {
namespace {

float value(const char* name, float lambda) {
  const SpectrumPtr s = named_spectrum(name);
  if (!s) {
    ADD_FAILURE() << name << " is missing";
    return 0;
  }
  return (*s)(lambda);
}

TEST(NamedSpectra, AllNamesOfTheSceneFormatExist) {
  std::vector<std::string> expected = {
      "glass-BK7",  "glass-BAF10",  "glass-FK51A",  "glass-LASF9",  "glass-F5",
      "glass-F10",  "glass-F11",    "glass-SF5",    "glass-SF10",   "glass-SF11",
      "stdillum-A", "stdillum-D50", "stdillum-D65", "illum-acesD60"};
  for (const char* metal : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"}) {
    expected.push_back(std::string("metal-") + metal + "-eta");
    expected.push_back(std::string("metal-") + metal + "-k");
  }
  for (int i = 1; i <= 12; ++i) expected.push_back("stdillum-F" + std::to_string(i));
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(named_spectra(), expected);
  for (const std::string& name : expected) EXPECT_NE(named_spectrum(name), nullptr) << name;
  EXPECT_EQ(named_spectrum("metal-Xy-eta"), nullptr);
  EXPECT_EQ(named_spectrum(""), nullptr);
}

TEST(NamedSpectra, GlassesHaveTheirCatalogueIndex) {
  // Schott's n_d, at the yellow helium line. Points are about 21 nm apart: with a curvature below
  // 1e-6 / nm^2 the error of a chord is at most 21^2 / 8 * 1e-6.
  const float d_line = 587.56f;
  EXPECT_NEAR(value("glass-BK7", d_line), 1.51680f, 6e-5f);
  EXPECT_NEAR(value("glass-BAF10", d_line), 1.67003f, 6e-5f);
  EXPECT_NEAR(value("glass-FK51A", d_line), 1.48656f, 6e-5f);
  EXPECT_NEAR(value("glass-LASF9", d_line), 1.85025f, 6e-5f);
  EXPECT_NEAR(value("glass-SF5", d_line), 1.67271f, 6e-5f);
  EXPECT_NEAR(value("glass-SF10", d_line), 1.72828f, 6e-5f);
  EXPECT_NEAR(value("glass-SF11", d_line), 1.78472f, 6e-5f);
  EXPECT_EQ(value("glass-F11", d_line), value("glass-SF11", d_line));
}

TEST(NamedSpectra, MetalsAreTheirTablesAndLinearBetween) {
  EXPECT_FLOAT_EQ(value("metal-Ag-eta", 855.063293f), 0.151938f);
  EXPECT_FLOAT_EQ(value("metal-Ag-k", 855.063293f), 5.720624f);
  EXPECT_FLOAT_EQ(value("metal-Cu-eta", 0.5f * (855.063293f + 885.601257f)), 0.29f);
  EXPECT_EQ(value("metal-MgO-k", 500), 0.0f);
  // Gold absorbs blue more than red: its index falls from above 1 to below.
  EXPECT_GT(value("metal-Au-eta", 450), 1.0f);
  EXPECT_LT(value("metal-Au-eta", 650), 0.3f);
}

TEST(NamedSpectra, ValuesContinueBeyondTheTableWithinTheVisibleRange) {
  EXPECT_FLOAT_EQ(value("metal-MgO-eta", 800), 1.72872f);
  EXPECT_FLOAT_EQ(value("metal-MgO-eta", 830), 1.72872f);
  EXPECT_FLOAT_EQ(value("glass-SF10", 360), 1.79057889f);
  EXPECT_FLOAT_EQ(value("glass-SF10", 359.5f), 1.79057889f);
  EXPECT_EQ(value("glass-SF10", 358), 0.0f);
}

TEST(NamedSpectra, IlluminantsHaveLuminanceOneAndTheirChromaticity) {
  struct Known {
    const char* name;
    float x, y;
  };
  // CIE 15:2004, two-degree observer, four decimals; ACES white from TB-2018-001. Fluorescent lamps
  // are tabulated every 5 nm; CIE sums these, we sum every 1 nm. Our D50 is pbrt-v4's, which is
  // bluer than CIE's (0.3457, 0.3585).
  const Known known[] = {{"stdillum-A", 0.44758f, 0.40745f},   {"stdillum-D50", 0.3368f, 0.3580f},
                         {"stdillum-D65", 0.31272f, 0.32903f}, {"stdillum-F2", 0.3721f, 0.3751f},
                         {"stdillum-F7", 0.3129f, 0.3292f},    {"stdillum-F11", 0.3805f, 0.3769f},
                         {"illum-acesD60", 0.32168f, 0.33767f}};
  for (const Known& k : known) {
    const Xyz c = spectrum_to_xyz(*named_spectrum(k.name));
    const float sum = c.x + c.y + c.z;
    EXPECT_NEAR(c.y, 1.0f, 1e-6f) << k.name;
    EXPECT_NEAR(c.x / sum, k.x, 5e-4f) << k.name;
    EXPECT_NEAR(c.y / sum, k.y, 5e-4f) << k.name;
  }
}

TEST(NamedSpectra, IlluminantAIsAPlanckianRadiator) {
  // CIE 015 defines it by this formula with c2 / T = 1.435e7 / 2848 nm.
  const auto planck = [](double l) { return std::pow(l, -5) / std::expm1(1.435e7 / (2848.0 * l)); };
  const SpectrumPtr a = named_spectrum("stdillum-A");
  // Exact at multiples of 5 nm, up to the six digits of the table.
  for (int l = 360; l <= 830; l += 5) {
    const float lambda = static_cast<float>(l);
    EXPECT_NEAR((*a)(lambda) / (*a)(560), planck(l) / planck(560), 1e-5 * planck(l) / planck(560));
  }
}

TEST(NamedSpectra, IlluminantsAreLookedUpAtTheNearestNanometre) {
  const SpectrumPtr s = named_spectrum("stdillum-F11");
  EXPECT_EQ((*s)(543.4f), (*s)(543.0f));
  EXPECT_EQ((*s)(543.6f), (*s)(544.0f));
  EXPECT_NE((*s)(543.0f), (*s)(544.0f));
  EXPECT_EQ((*s)(830.6f), 0.0f);
  EXPECT_EQ((*s)(359.4f), 0.0f);
  const auto lambda = SampledWavelengths::sample_visible(0.2f);
  for (int i = 0; i < kSpectrumSamples; ++i)
    EXPECT_EQ(s->sample(lambda)[i], (*s)(lambda.lambda(i)));
}

TEST(NamedSpectra, DaylightIsTheStandardIlluminantAtItsTemperature) {
  // D65 is daylight at 6500 K. The standard rounds both factors of the series to three decimals.
  const SpectrumPtr made = daylight_spectrum(6500), standard = named_spectrum("stdillum-D65");
  for (int l = 380; l <= 780; l += 10) {
    const float lambda = static_cast<float>(l);
    EXPECT_NEAR((*made)(lambda) / (*made)(560), (*standard)(lambda) / (*standard)(560), 2e-3f) << l;
  }
  // CIE's chromaticities of D50 and D75, on both sides of the joint of the series at 7000 K.
  const auto expect_chromaticity = [](float kelvin, float x, float y) {
    const Xyz c = spectrum_to_xyz(*daylight_spectrum(kelvin));
    EXPECT_NEAR(c.x / (c.x + c.y + c.z), x, 3e-4f) << kelvin;
    EXPECT_NEAR(c.y / (c.x + c.y + c.z), y, 3e-4f) << kelvin;
  };
  expect_chromaticity(5000, 0.34567f, 0.35851f);
  expect_chromaticity(7500, 0.29903f, 0.31488f);
  // The series is undefined below 4000 K.
  EXPECT_EQ((*daylight_spectrum(3000))(600), (*blackbody_spectrum(3000))(600));
}

}  // namespace
}  // namespace nephroid
