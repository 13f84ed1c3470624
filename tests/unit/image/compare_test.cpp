// Error measures against hand-computed numbers, and the guarantees of the heat map's colours.
#include "image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/errors.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

/// One row of pixels.
Picture picture_of(const std::vector<std::string>& channels, const std::vector<float>& pixels) {
  Picture picture;
  picture.channels = channels;
  picture.pixels = pixels;
  const int width = static_cast<int>(pixels.size() / channels.size());
  picture.window = {0, 0, width, 1};
  picture.full_width = width;
  picture.full_height = 1;
  return picture;
}
Picture rgb(const std::vector<float>& pixels) {
  return picture_of({"R", "G", "B"}, pixels);
}

const std::vector<std::string> kWithError = {"R", "G", "B", "stderr.R", "stderr.G", "stderr.B"};

TEST(Compare, HandComputed) {
  const Picture reference = rgb({1, 1, 1, 0, 0, 0, 2, 2, 2});
  const Picture test = rgb({2, 1, 1, 0.1f, 0, 0, 2, 2, 0});
  const Comparison c = compare_pictures(reference, test, {});
  // Squared differences 1, 0.01 and 4 over nine values.
  EXPECT_NEAR(c.rmse, std::sqrt(5.01 / 9), 1e-7);
  const double pixels[3] = {1 / 1.01 / 3, 0.01 / 0.01 / 3, 4 / 4.01 / 3};
  EXPECT_NEAR(c.relmse, (pixels[0] + pixels[1] + pixels[2]) / 3, 1e-7);
  // Only the worst pixel is dropped: the second is 1/3, the third slightly less.
  EXPECT_NEAR(c.relmse_trim, (pixels[0] + pixels[2]) / 2, 1e-7);
  EXPECT_NEAR(c.mean.value, (2 + 1 + 1 + 0.1 + 2 + 2) / 9 - 1, 1e-7);
  EXPECT_FALSE(c.mean.half_width.has_value());
}

TEST(Compare, TellsWhetherColoursAreTheSame) {
  const Picture reference = rgb({1, 1, 1, 0, 0, 0});
  EXPECT_TRUE(compare_pictures(reference, rgb({1, 1, 1, 0, 0, 0}), {}).is_same);
  EXPECT_FALSE(
      compare_pictures(reference, rgb({1, 1, std::nextafter(1.0f, 2.0f), 0, 0, 0}), {}).is_same);
}

TEST(Compare, TrimKeepsTheOnlyPixel) {
  const Comparison c = compare_pictures(rgb({1, 1, 1}), rgb({2, 1, 1}), {});
  EXPECT_GT(c.relmse, 0);
  EXPECT_EQ(c.relmse_trim, c.relmse);
}

TEST(Compare, TrimDropsOneInAThousand) {
  std::vector<float> reference(3 * 3000, 1.0f), test = reference;
  // Three pixels of 3000 may be dropped: the fourth largest stays.
  for (size_t i = 0; i < 4; ++i) test[3 * 700 * i] = 1 + 10 * static_cast<float>(i + 1);
  const Comparison c = compare_pictures(rgb(reference), rgb(test), {});
  EXPECT_NEAR(c.relmse_trim, 100 / 1.01 / 3 / 2997, 1e-9);
}

TEST(Compare, ColorsOfTwoSpacesAreOfOne) {
  const RgbColorSpace& wide = *RgbColorSpace::find("rec2020");
  const Rgb color{0.8f, 0.3f, 0.1f};
  const Rgb same = wide.from_xyz(RgbColorSpace::srgb().to_xyz(color));
  const Picture reference = rgb({color.r, color.g, color.b});
  Picture test = rgb({same.r, same.g, same.b});
  EXPECT_GT(compare_pictures(reference, test, {}).relmse, 0.01);
  test.color_space = &wide;
  EXPECT_LT(compare_pictures(reference, test, {}).relmse, 1e-10);
  EXPECT_LT(compare_pictures(test, reference, {}).relmse, 1e-10);
  EXPECT_LT(relative_squared_errors(reference, test)[0], 1e-10);
}

TEST(Compare, DeviationsNeedErrorsInTheSameSpace) {
  const Picture reference = picture_of(kWithError, {1, 1, 1, 0.1f, 0.1f, 0.1f});
  Picture test = reference;
  EXPECT_TRUE(compare_pictures(reference, test, {}).deviations.has_value());
  test.color_space = RgbColorSpace::find("rec2020");
  EXPECT_FALSE(compare_pictures(reference, test, {}).deviations.has_value());
}

TEST(Compare, ChannelsByNameElseTheFirstThree) {
  const Picture named = picture_of({"A", "B", "G", "R"}, {9, 3, 2, 1});
  const Picture unnamed = picture_of({"x", "y", "z", "w"}, {1, 2, 3, 7});
  EXPECT_EQ(compare_pictures(named, unnamed, {}).rmse, 0.0);
  EXPECT_THROW(compare_pictures(named, picture_of({"Y"}, {1}), {}), UsageError);
}

TEST(Compare, SizesMustAgree) {
  EXPECT_THROW(compare_pictures(rgb({1, 1, 1}), rgb({1, 1, 1, 1, 1, 1}), {}), UsageError);
}

TEST(Compare, NotFiniteIsHuge) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Comparison c = compare_pictures(rgb({1, 1, 1}), rgb({nan, -kInfinity, 1}), {});
  EXPECT_NEAR(c.rmse, std::sqrt((std::pow(1e6 - 1, 2) + std::pow(1e6 + 1, 2)) / 3), 1e-3);
}

TEST(Compare, DimMeanLeavesBrightPixelsOutAndPropagatesBothErrors) {
  const Picture reference = picture_of(kWithError, {1, 2, 3, 0.1f, 0.1f, 0.2f,  //
                                                    50, 1, 1, 9, 9, 9,          //
                                                    2, 2, 2, 0, 0, 0.3f});
  const Picture test = picture_of(kWithError, {1, 2, 4, 0.2f, 0.2f, 0.2f,  //
                                               1, 1, 1, 9, 9, 9,           //
                                               2, 3, 2, 0, 0.1f, 0});
  const MeanRatio r = compare_pictures(reference, test, {}).dim_mean;
  EXPECT_EQ(r.pixels, 2u);
  const double ratio = 14.0 / 12.0;
  EXPECT_NEAR(r.value, ratio - 1, 1e-12);
  // Channels are fully correlated, pixels independent: per pixel, sums of stderr squared.
  const double test_variance = 0.6 * 0.6 + 0.1 * 0.1;
  const double reference_variance = 0.4 * 0.4 + 0.3 * 0.3;
  const double sigma = std::sqrt(test_variance + ratio * ratio * reference_variance) / 12.0;
  ASSERT_TRUE(r.half_width.has_value());
  EXPECT_NEAR(*r.half_width, 1.959964 * sigma, 1e-7);
}

TEST(Compare, DimMeanIntervalNeedsAnError) {
  const Picture plain = rgb({1, 1, 1});
  EXPECT_FALSE(compare_pictures(plain, plain, {}).dim_mean.half_width.has_value());
  const Picture with = picture_of(kWithError, {1, 1, 1, 0.1f, 0.1f, 0.1f});
  EXPECT_NEAR(*compare_pictures(plain, with, {}).dim_mean.half_width, 1.959964 * 0.3 / 3, 1e-6);
  EXPECT_NEAR(*compare_pictures(with, plain, {}).dim_mean.half_width, 1.959964 * 0.3 / 3, 1e-6);
}

// A black reference has no relative mean: it is not defined instead of infinite.
TEST(Compare, MeansOfABlackReferenceAreUndefined) {
  const Picture black = picture_of(kWithError, {0, 0, 0, 0.1f, 0.1f, 0.1f});
  for (const Picture& test : {rgb({1, 2, 3}), rgb({0, 0, 0})}) {
    const Comparison c = compare_pictures(black, test, {});
    EXPECT_FALSE(c.mean.is_defined());
    EXPECT_FALSE(c.dim_mean.is_defined());
    EXPECT_FALSE(c.dim_mean.half_width.has_value());
    EXPECT_EQ(c.dim_mean.pixels, 1u);
    EXPECT_TRUE(std::isfinite(c.rmse) && std::isfinite(c.relmse));
  }
  const Comparison lit = compare_pictures(rgb({1, 2, 3}), black, {});
  EXPECT_TRUE(lit.mean.is_defined() && lit.dim_mean.is_defined());
  EXPECT_EQ(lit.mean.value, -1);
}

TEST(Compare, ReferenceErrorIsSubtracted) {
  const Picture reference = picture_of(kWithError, {1, 1, 1, 0.1f, 0, 0, 0, 0, 0, 0, 0, 0.3f});
  const Picture test = rgb({1.5f, 1, 1, 1, 0, 0});
  CompareOptions subtract;
  subtract.subtract_reference_error = true;
  const Comparison c = compare_pictures(reference, test, subtract);
  EXPECT_NEAR(c.rmse, std::sqrt((0.25 + 1 - 0.01 - 0.09) / 6), 1e-7);
  const double first = (0.25 - 0.01) / 1.01 / 3, second = (1 - 0.09) / 0.01 / 3;
  EXPECT_NEAR(c.relmse, (first + second) / 2, 1e-5);
  EXPECT_NEAR(c.relmse_trim, first, 1e-7);
  EXPECT_THROW(compare_pictures(test, test, subtract), UsageError);
}

double luminance(const HeatColor& c) {
  const auto linear = [](uint8_t code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

TEST(Compare, DeviationsAreInUnitsOfBothErrors) {
  const Picture reference =
      picture_of(kWithError, {1, 1, 1, .3f, .3f, .3f, 2, 2, 2, 0, 0, 0, 3, 3, 3, 0, 0, 0});
  // z of 2 in one channel, of 4 in one channel, and an equal pixel without an error.
  const Picture test =
      picture_of(kWithError, {2, 1, 1, .4f, .4f, .4f, 2, 6, 2, 1, 1, 1, 3, 3, 3, 0, 0, 0});
  const Comparison c = compare_pictures(reference, test, {});
  ASSERT_TRUE(c.deviations);
  EXPECT_NEAR(c.deviations->share_within, 2.0 / 3, 1e-12);
  EXPECT_NEAR(c.deviations->rms, std::sqrt((4.0 + 16.0) / 9), 1e-6);
  // One of nine values is two standard errors off, another one four.
  EXPECT_NEAR(c.deviations->share_in_95, 7.0 / 9, 1e-12);
  EXPECT_FALSE(compare_pictures(reference, rgb({1, 1, 1, 2, 2, 2, 3, 3, 3}), {}).deviations);
}

TEST(HeatMap, LargerErrorsAreLighter) {
  double last = -1;
  // Steps of an eighth of a decade are far above the rounding of codes.
  for (double exponent = -5; exponent <= 1.0001; exponent += 0.125) {
    const double y = luminance(heat_color(std::pow(10.0, exponent)));
    EXPECT_GT(y, last) << exponent;
    last = y;
  }
  EXPECT_EQ(luminance(heat_color(0)), luminance(heat_color(kHeatMin)));
  EXPECT_EQ(luminance(heat_color(1e9)), luminance(heat_color(kHeatMax)));
}

TEST(HeatMap, WritesOneColourAPixelAndItsScale) {
  const ScratchDirectory directory;
  const std::string path = directory.file("heat.png");
  write_heat_map(path, rgb({1, 1, 1, 1, 1, 1}), rgb({1, 1, 1, 2, 2, 2}));
  const Picture heat = read_picture(path);
  ASSERT_EQ(heat.width(), 2);
  const HeatColor none = heat_color(0), some = heat_color(1 / 1.01);
  EXPECT_EQ(encode_srgb8(heat.pixels[0]), none.r);
  EXPECT_EQ(encode_srgb8(heat.pixels[3]), some.r);
  EXPECT_EQ(encode_srgb8(heat.pixels[4]), some.g);
  EXPECT_NE(heat_map_legend().find("0.001\n"), std::string::npos);
  EXPECT_NE(heat_map_legend().find("10 or more\n"), std::string::npos);
}

}  // namespace
}  // namespace nephroid
