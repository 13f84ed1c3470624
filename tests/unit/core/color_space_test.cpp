// Colour spaces: matrices, and the round trip rgb -> reflectance spectrum -> rgb under the standard
// illuminant of the space.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/color.h"
#include "core/color_fit.h"
#include "core/spectra.h"

namespace nephroid {
namespace {

constexpr const char* kSpaces[] = {"srgb", "dci-p3", "rec2020", "aces2065-1"};

/// Rgb of a reflectance under the standard illuminant, summed in double precision.
std::array<double, 3> seen_colour(const RgbColorSpace& space, const SigmoidPolynomial& s) {
  double xyz[3] = {}, norm = 0;
  for (int l = 360; l <= 830; ++l) {
    const float lambda = static_cast<float>(l);
    const double light = space.illuminant()(lambda), value = s(lambda);
    const Xyz curve = cie_xyz(lambda);
    xyz[0] += value * light * curve.x;
    xyz[1] += value * light * curve.y;
    xyz[2] += value * light * curve.z;
    norm += light * curve.y;
  }
  std::array<double, 3> rgb{};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) rgb[r] += space.matrix_from_xyz()[r][c] * xyz[c] / norm;
  return rgb;
}

struct Errors {
  double mean = 0, most = 0;
};

/// Round trip of the colours low + (high - low) * (i, j, k) / (n - 1).
Errors round_trip(const RgbColorSpace& space, float low, float high, int n) {
  Errors errors;
  const auto component = [&](int i) {
    return low + (high - low) * static_cast<float>(i) / static_cast<float>(n - 1);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Rgb rgb{component(i), component(j), component(k)};
        const auto seen = seen_colour(space, space.polynomial(rgb));
        double error = 0;
        for (int c = 0; c < 3; ++c) error = std::max(error, std::abs(seen[c] - rgb[c]));
        errors.mean += error / (n * n * n);
        errors.most = std::max(errors.most, error);
      }
  return errors;
}

TEST(RgbColorSpace, OnlyTheFourSpacesExist) {
  for (const char* name : kSpaces) {
    const RgbColorSpace* space = RgbColorSpace::find(name);
    ASSERT_NE(space, nullptr) << name;
    EXPECT_EQ(space->name(), name);
    EXPECT_EQ(space, RgbColorSpace::find(name));
  }
  EXPECT_EQ(RgbColorSpace::find("adobe"), nullptr);
  EXPECT_EQ(&RgbColorSpace::srgb(), RgbColorSpace::find("srgb"));
}

TEST(RgbColorSpace, MatricesArePublishedOnes) {
  // IEC 61966-2-1, ITU-R BT.2020 and SMPTE ST 2065-1 round white points to four decimals, which
  // changes entries by up to 2e-3.
  const float srgb[3][3] = {
      {3.2406f, -1.5372f, -0.4986f}, {-0.9689f, 1.8758f, 0.0415f}, {0.0557f, -0.2040f, 1.0570f}};
  const float rec2020[3][3] = {
      {1.7167f, -0.3557f, -0.2534f}, {-0.6667f, 1.6165f, 0.0158f}, {0.0176f, -0.0428f, 0.9421f}};
  const float aces[3][3] = {
      {1.0498f, 0.0f, -0.0001f}, {-0.4959f, 1.3733f, 0.0982f}, {0.0f, 0.0f, 0.9913f}};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(RgbColorSpace::srgb().matrix_from_xyz()[r][c], srgb[r][c], 2e-3f);
      EXPECT_NEAR(RgbColorSpace::find("rec2020")->matrix_from_xyz()[r][c], rec2020[r][c], 2e-3f);
      EXPECT_NEAR(RgbColorSpace::find("aces2065-1")->matrix_from_xyz()[r][c], aces[r][c], 2e-3f);
    }
}

TEST(RgbColorSpace, WhiteIsTheIlluminantAndMatricesAreInverse) {
  for (const char* name : kSpaces) {
    const RgbColorSpace& space = *RgbColorSpace::find(name);
    const Rgb white = space.from_xyz(spectrum_to_xyz(space.illuminant()));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1.0f, 2e-6f) << name;
    const Rgb colour{0.2f, 0.5f, 0.9f}, back = space.from_xyz(space.to_xyz(colour));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], colour[c], 2e-6f) << name;
  }
}

TEST(RgbColorSpace, SrgbColoursComeBack) {
  // The table is exact to about 1e-3 at its nodes. Interpolation between them adds 2e-4 on average.
  // The worst colours are pale yellows with two components at 1, where the exact polynomial tends
  // to infinity.
  const Errors all = round_trip(RgbColorSpace::srgb(), 0.0f, 1.0f, 14);
  EXPECT_LT(all.mean, 4e-4);
  EXPECT_LT(all.most, 1e-2);
  // Colours of real surfaces are better.
  EXPECT_LT(round_trip(RgbColorSpace::srgb(), 0.03f, 0.9f, 14).most, 2e-3);
}

TEST(RgbColorSpace, MutedColoursComeBackInEverySpace) {
  // Wide spaces contain colours that no surface has and that do not survive a round trip. Muted
  // colours must. In a wider space the same numbers are more saturated, and the interpolation error
  // grows.
  for (const char* name : kSpaces)
    EXPECT_LT(round_trip(*RgbColorSpace::find(name), 0.3f, 0.7f, 8).most, 2.5e-3) << name;
}

TEST(RgbColorSpace, EmissionOfTheCornellBoxMatchesPbrt) {
  // pbrt-v4 shows its light of rgb (17, 12, 4) as (17.0028, 11.9952, 3.9942), within 1e-3. Its
  // table has the same nodes, hence an error of the same size: 2e-4 of the scale of 34.
  const Rgb rgb{17.0f / 34, 12.0f / 34, 4.0f / 34};
  const auto seen = seen_colour(RgbColorSpace::srgb(), RgbColorSpace::srgb().polynomial(rgb));
  EXPECT_NEAR(34 * seen[0], 17.0028, 7e-3);
  EXPECT_NEAR(34 * seen[1], 11.9952, 7e-3);
  EXPECT_NEAR(34 * seen[2], 3.9942, 7e-3);
}

TEST(RgbColorSpace, GreysAreConstantSpectra) {
  for (const char* name : kSpaces)
    for (const float grey : {0.0f, 1e-4f, 0.18f, 0.5f, 0.99f, 1.0f}) {
      const SigmoidPolynomial s = RgbColorSpace::find(name)->polynomial({grey, grey, grey});
      for (const float lambda : {360.0f, 555.5f, 830.0f})
        EXPECT_NEAR(s(lambda), grey, 1e-6f) << name << " " << lambda;
    }
}

TEST(RgbColorSpace, OutOfRangeComponentsAreClamped) {
  const RgbColorSpace& space = RgbColorSpace::srgb();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto expect_same = [&](Rgb a, Rgb b) {
    const SigmoidPolynomial p = space.polynomial(a), q = space.polynomial(b);
    EXPECT_EQ(p.c0, q.c0);
    EXPECT_EQ(p.c1, q.c1);
    EXPECT_EQ(p.c2, q.c2);
  };
  expect_same({1.7f, -0.2f, 0.5f}, {1.0f, 0.0f, 0.5f});
  expect_same({nan, 0.2f, 0.5f}, {0.0f, 0.2f, 0.5f});
}

TEST(RgbColorSpace, DarkestAndAlmostGreyColoursAreFinite) {
  for (const Rgb rgb : {Rgb{1e-30f, 0, 0}, Rgb{0, 1e-7f, 0}, Rgb{0.5f, 0.5f, 0.49999997f},
                        Rgb{1, 1, 0.9999999f}, Rgb{1, 0, 0}, Rgb{0, 0, 1}}) {
    const SigmoidPolynomial s = RgbColorSpace::srgb().polynomial(rgb);
    const auto seen = seen_colour(RgbColorSpace::srgb(), s);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], rgb[c], 3e-3) << rgb.r << rgb.g << rgb.b;
  }
}

TEST(SigmoidPolynomial, SamplesAgreeAndTheMaximumIsAttained) {
  const SampledWavelengths lambda = SampledWavelengths::sample_visible(0.6f);
  for (const Rgb rgb : {Rgb{0.9f, 0.1f, 0.2f}, Rgb{0.1f, 0.8f, 0.1f}, Rgb{0.3f, 0.1f, 0.9f},
                        Rgb{0.7f, 0.1f, 0.7f}, Rgb{0.4f, 0.4f, 0.4f}}) {
    const SigmoidPolynomial s = RgbColorSpace::srgb().polynomial(rgb);
    const SampledSpectrum values = s.sample(lambda);
    for (int i = 0; i < kSpectrumSamples; ++i) EXPECT_FLOAT_EQ(values[i], s(lambda.lambda(i)));
    float most = 0;
    for (int i = 0; i <= 4700; ++i) most = std::max(most, s(360.0f + 0.1f * static_cast<float>(i)));
    EXPECT_GE(s.max_value(), most);
    EXPECT_NEAR(s.max_value(), most, 1e-4f);
  }
}

TEST(SigmoidTable, NodesAreFittedAndThreadsDoNotMatter) {
  std::vector<float> curves[4];
  for (int l = 360; l <= 830; ++l) {
    const float lambda = static_cast<float>(l);
    const Xyz c = cie_xyz(lambda);
    curves[0].push_back(c.x);
    curves[1].push_back(c.y);
    curves[2].push_back(c.z);
    curves[3].push_back(RgbColorSpace::srgb().illuminant()(lambda));
  }
  const FitCurves input{curves[0], curves[1], curves[2], curves[3]};
  const int res = 24;
  const SigmoidTable table = fit_sigmoid_table(input, kSrgbPrimaries, res, 1);
  EXPECT_EQ(table.coefficients, fit_sigmoid_table(input, kSrgbPrimaries, res, 3).coefficients);
  EXPECT_EQ(table.nodes.front(), 0.0f);
  EXPECT_EQ(table.nodes.back(), 1.0f);

  double mean = 0, most = 0;
  for (int largest = 0; largest < 3; ++largest)
    for (int k = 0; k < res; ++k)
      for (int j = 0; j < res; ++j)
        for (int i = 0; i < res; ++i) {
          const size_t at = 3 * (((static_cast<size_t>(largest) * res + k) * res + j) * res + i);
          const auto seen = seen_colour(
              RgbColorSpace::srgb(),
              {table.coefficients[at], table.coefficients[at + 1], table.coefficients[at + 2]});
          const double z = table.nodes[k];
          const double error = std::max({std::abs(seen[largest] - z),
                                         std::abs(seen[(largest + 1) % 3] - z * i / (res - 1)),
                                         std::abs(seen[(largest + 2) % 3] - z * j / (res - 1))});
          most = std::max(most, error);
          mean += error / static_cast<double>(table.coefficients.size() / 3);
        }
  // Most nodes are exact to float precision. At black, white and pure hues, the bound that keeps
  // coefficients finite costs accuracy.
  EXPECT_LT(mean, 2e-5);
  EXPECT_LT(most, 3e-3);
}

}  // namespace
}  // namespace nephroid
