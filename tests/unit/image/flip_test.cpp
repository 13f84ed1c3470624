// FLIP: general properties, and values of a second implementation, written from the paper with
// two-dimensional filters. This one uses separable filters.
#include "image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/errors.h"

namespace nephroid {
namespace {

/// Pseudo-random colours in [0,1].
std::vector<Rgb> pattern(int width, int height, int k) {
  std::vector<Rgb> colors;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = 7 * x + 13 * y + 5 * k;
      colors.push_back({static_cast<float>(i * 37 % 101) / 100,
                        static_cast<float>(i * 53 % 97) / 96,
                        static_cast<float>(i * 29 % 89) / 88});
    }
  return colors;
}

/// A pattern mixed with a share of another one.
std::vector<Rgb> disturbed(int width, int height, float share) {
  std::vector<Rgb> colors = pattern(width, height, 0);
  const std::vector<Rgb> other = pattern(width, height, 3);
  for (size_t i = 0; i < colors.size(); ++i)
    colors[i] = colors[i] * (1 - 2 * share) + other[i] * share;
  return colors;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<Rgb> plain(int width, int height, const Rgb& color) {
  return std::vector<Rgb>(static_cast<size_t>(width) * static_cast<size_t>(height), color);
}

TEST(Flip, NothingDiffersFromItself) {
  for (const double error : flip_errors(12, 9, pattern(12, 9, 0), pattern(12, 9, 0)))
    EXPECT_EQ(error, 0);
}

TEST(Flip, SymmetricAndBounded) {
  const auto a = pattern(12, 9, 0), b = pattern(12, 9, 4);
  const auto there = flip_errors(12, 9, a, b), back = flip_errors(12, 9, b, a);
  for (size_t i = 0; i < there.size(); ++i) {
    EXPECT_NEAR(there[i], back[i], 1e-12);
    EXPECT_GE(there[i], 0);
    EXPECT_LE(there[i], 1);
  }
}

TEST(Flip, GrowsWithTheDistortion) {
  double last = 0;
  for (const float share : {0.02f, 0.05f, 0.1f, 0.2f, 0.4f}) {
    const double error = mean(flip_errors(12, 9, pattern(12, 9, 0), disturbed(12, 9, share)));
    EXPECT_GT(error, last) << share;
    last = error;
  }
}

// Colours are floats here and doubles in the other implementation.
constexpr double kTolerance = 2e-6;

TEST(Flip, ValuesOfTheSecondImplementation) {
  const auto a = pattern(12, 9, 0), b = disturbed(12, 9, 0.1f);
  const auto near = flip_errors(12, 9, a, b);
  EXPECT_NEAR(mean(near), 0.20320309758518332, kTolerance);
  EXPECT_NEAR(near[0], 0.24532326502866048, kTolerance);
  EXPECT_NEAR(near[4 * 12 + 7], 0.1498061285094215, kTolerance);
  EXPECT_NEAR(near[8 * 12 + 11], 0.32101581980667715, kTolerance);
  const auto far = flip_errors(12, 9, a, b, 20);
  EXPECT_NEAR(mean(far), 0.3056782065368716, kTolerance);
  EXPECT_NEAR(far[0], 0.5689449224784994, kTolerance);
  EXPECT_NEAR(far[4 * 12 + 7], 0.1884319043016255, kTolerance);
  EXPECT_NEAR(far[8 * 12 + 11], 0.45975947824305957, kTolerance);

  const auto black = plain(5, 5, {0, 0, 0});
  EXPECT_NEAR(mean(flip_errors(5, 5, black, plain(5, 5, {1, 1, 1}))), 0.9673805163472085,
              kTolerance);
  auto dot = black;
  dot[12] = {1, 1, 1};
  const auto of_dot = flip_errors(5, 5, black, dot);
  EXPECT_NEAR(of_dot[12], 0.8649166613751587, kTolerance);
  EXPECT_NEAR(of_dot[14], 0.48056690148885756, kTolerance);
  EXPECT_NEAR(mean(of_dot), 0.4933983099971481, kTolerance);
}

TEST(Flip, GreenAndBlueAreFurthestApart) {
  EXPECT_NEAR(mean(flip_errors(4, 4, plain(4, 4, {0, 1, 0}), plain(4, 4, {0, 0, 1}))), 1, 1e-3);
}

Picture row_of_pixels(const std::vector<std::string>& channels, const std::vector<float>& pixels) {
  Picture picture;
  picture.channels = channels;
  picture.pixels = pixels;
  const int width = static_cast<int>(pixels.size() / channels.size());
  picture.window = {0, 0, width, 1};
  picture.full_width = width;
  picture.full_height = 1;
  return picture;
}

TEST(Flip, ColoursAsAScreenShowsThem) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto colors = display_colors(
      row_of_pixels({"B", "Z", "G", "R"}, {0.1f, 9, 0.2f, 3, nan, 9, -1, 0.5f}), 0.5f);
  ASSERT_EQ(colors.size(), 2u);
  EXPECT_EQ(colors[0].r, 1);
  EXPECT_FLOAT_EQ(colors[0].g, 0.1f);
  EXPECT_FLOAT_EQ(colors[0].b, 0.05f);
  EXPECT_FLOAT_EQ(colors[1].r, 0.25f);
  EXPECT_EQ(colors[1].g, 0);
  EXPECT_EQ(colors[1].b, 0);
  // Full green of a wider space is outside sRGB: no red is left.
  Picture wide = row_of_pixels({"R", "G", "B"}, {0, 0.5f, 0});
  wide.color_space = RgbColorSpace::find("rec2020");
  const Rgb green = display_colors(wide, 1)[0];
  EXPECT_EQ(green.r, 0);
  EXPECT_GT(green.g, 0.5f);
  EXPECT_THROW(display_colors(row_of_pixels({"Y"}, {1}), 1), UsageError);
}

TEST(Flip, ExposureAndSizes) {
  const Picture a = row_of_pixels({"R", "G", "B"}, {0.2f, 0.2f, 0.2f, 0.4f, 0.4f, 0.4f});
  const Picture b = row_of_pixels({"R", "G", "B"}, {0.3f, 0.2f, 0.2f, 0.4f, 0.4f, 0.4f});
  EXPECT_EQ(flip(a, a, 1), 0);
  EXPECT_GT(flip(a, b, 1), 0);
  // Both are white at this exposure.
  EXPECT_EQ(flip(a, b, 10), 0);
  EXPECT_THROW(flip(a, row_of_pixels({"R", "G", "B"}, {1, 1, 1}), 1), UsageError);
}

}  // namespace
}  // namespace nephroid
