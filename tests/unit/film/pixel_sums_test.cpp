// Compact sums: exact in any order, rounded to steps of 2^-44, with carries where they are needed.
#include "film/pixel_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "core/parallel.h"
#include "core/sampler.h"
#include "film/film.h"

namespace nephroid {
namespace {

constexpr double kStep = 0x1p-44;

double red(const PixelSums& sums, size_t pixel) {
  return sums.sum(pixel).rgb[0].value();
}
bool same(const PixelSums& a, const PixelSums& b, size_t pixel) {
  for (int c = 0; c < 3; ++c)
    if (a.sum(pixel).rgb[c].bits != b.sum(pixel).rgb[c].bits) return false;
  return true;
}

/// Colours of both signs and of 60 magnitudes, up to 2^30.
std::vector<Rgb> colors(size_t count) {
  std::vector<Rgb> colors;
  const auto number = [](uint64_t i) {
    const uint64_t bits = mix_bits(i + 1);
    return std::ldexp(static_cast<float>(bits >> 40) * 0x1p-24f - 0.4f,
                      static_cast<int>(bits % 60) - 30);
  };
  for (size_t i = 0; i < 3 * count; i += 3)
    colors.push_back({number(i), number(i + 1), number(i + 2)});
  return colors;
}

TEST(PixelSums, AddsInSteps) {
  PixelSums sums(2);
  EXPECT_TRUE(sums.add(1, Rgb{1, 0.25f, -3}));
  EXPECT_TRUE(sums.add(1, Rgb{static_cast<float>(kStep), 0, 0}));
  EXPECT_EQ(red(sums, 1), 1 + kStep);
  EXPECT_EQ(sums.sum(1).rgb[1].value(), 0.25);
  EXPECT_EQ(sums.sum(1).rgb[2].value(), -3);
  EXPECT_EQ(red(sums, 0), 0);
  // Half a step counts as one, less as none; x and -x cancel.
  for (const float value : {0.5f, 0.49f, -0.5f, -0.49f})
    sums.add(0, Rgb{value * static_cast<float>(kStep), value, 0});
  EXPECT_EQ(red(sums, 0), 0);
  sums.add(0, Rgb{0.5f * static_cast<float>(kStep), 0, 0});
  EXPECT_EQ(red(sums, 0), kStep);
  sums.clear(1);
  EXPECT_EQ(red(sums, 1), 0);
}

TEST(PixelSums, AnyOrderHasTheSameBits) {
  std::vector<Rgb> values = colors(4000);
  PixelSums forward(1), backward(1), halves(1), other_half(1);
  for (const Rgb& value : values) forward.add(0, value);
  std::reverse(values.begin(), values.end());
  for (const Rgb& value : values) backward.add(0, value);
  for (size_t i = 0; i < values.size(); ++i) (i % 2 == 0 ? halves : other_half).add(0, values[i]);
  halves.add(0, other_half);
  EXPECT_TRUE(same(forward, backward, 0));
  EXPECT_TRUE(same(forward, halves, 0));
  EXPECT_EQ(forward.save_carries(), backward.save_carries());
  EXPECT_FALSE(forward.save_carries().empty());
}

TEST(PixelSums, IsTheSumOfTheFilmUpToSteps) {
  const std::vector<Rgb> values = colors(1000);
  PixelSums sums(1);
  RgbSum exact;
  for (const Rgb& value : values) {
    sums.add(0, value);
    for (int c = 0; c < 3; ++c) exact.rgb[c].add(double{value[c]});
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sums.sum(0).rgb[c].value(), exact.rgb[c].value(),
                500 * kStep + 1e-15 * std::abs(exact.rgb[c].value()));
}

TEST(PixelSums, CarriesAreThereWhereTheyAreNeeded) {
  PixelSums sums(3);
  for (int i = 0; i < 1000; ++i) sums.add(1, Rgb{-500, 500, 0.1f});
  EXPECT_TRUE(sums.save_carries().empty());
  // 64 bits hold 2^19.
  for (int i = 0; i < 1000; ++i) sums.add(1, Rgb{-500, 500, 0});
  EXPECT_EQ(red(sums, 1), -1e6);
  EXPECT_EQ(sums.sum(1).rgb[1].value(), 1e6);
  EXPECT_EQ(sums.save_carries().size(), 7u);
  const PixelSums copy = sums;
  EXPECT_TRUE(same(copy, sums, 1));
  sums.add(1, Rgb{1e6f, 0, 0});
  EXPECT_EQ(red(sums, 1), 0);
  EXPECT_EQ(red(copy, 1), -1e6);
}

TEST(PixelSums, SaturatesAndSaysSo) {
  PixelSums sums(1);
  EXPECT_TRUE(sums.add(0, Rgb{0x1p61f, 0, 0}));
  EXPECT_FALSE(sums.add(0, Rgb{0x1p62f, 1, 0}));
  EXPECT_EQ(red(sums, 0), 0x1p62);
  EXPECT_EQ(sums.sum(0).rgb[1].value(), 1);
  EXPECT_FALSE(sums.add(0, Rgb{0, -1e30f, 0}));
  EXPECT_EQ(sums.sum(0).rgb[1].value(), -0x1p62);
  EXPECT_FALSE(sums.add(0, Rgb{0, 0, std::numeric_limits<float>::quiet_NaN()}));
  EXPECT_EQ(sums.sum(0).rgb[2].value(), 0);
}

TEST(PixelSums, SquaresHaveFinerSteps) {
  PixelSums colors(1), squares(1, PixelSums::kSquareBits);
  const Rgb dim{0x1p-48f, 0x1p-47f, 0x1p18f};
  for (PixelSums* sums : {&colors, &squares}) EXPECT_TRUE(sums->add(0, dim));
  EXPECT_EQ(colors.sum(0).rgb[0].value(), 0);
  EXPECT_EQ(squares.sum(0).rgb[0].value(), 0x1p-48);
  EXPECT_EQ(squares.sum(0).rgb[1].value(), 0x1p-47);
  EXPECT_EQ(squares.sum(0).rgb[2].value(), 0x1p18);
  EXPECT_TRUE(colors.save_carries().empty());
  EXPECT_FALSE(squares.save_carries().empty());
  EXPECT_FALSE(squares.add(0, Rgb{0, 0, -0x1p100f}));
  EXPECT_EQ(squares.sum(0).rgb[2].value(), -0x1p62);
  EXPECT_FALSE(squares.is_zero(0));
  squares.clear(0);
  EXPECT_TRUE(squares.is_zero(0));
}

TEST(PixelSums, WordsAndCarriesAreAllThereIs) {
  PixelSums sums(4), loaded(4);
  for (size_t i = 0; i < 4; ++i)
    for (const Rgb& value : colors(50 * i)) sums.add(i, value);
  std::ranges::copy(sums.words(), loaded.words().begin());
  loaded.load_carries(sums.save_carries());
  for (size_t i = 0; i < 4; ++i) EXPECT_TRUE(same(sums, loaded, i)) << i;
  EXPECT_LE(sums.save_carries().size(), sums.most_carry_words());
  EXPECT_THROW(loaded.load_carries(std::vector<uint32_t>{4, 0, 0, 0, 0, 0, 1}), IoError);
  EXPECT_THROW(loaded.load_carries(std::vector<uint32_t>{1, 0, 0}), IoError);
}

TEST(PixelSums, CarriesAreWithinTheLimit) {
  const auto words = [](int64_t carry) {
    const auto bits = static_cast<uint64_t>(carry);
    return std::vector<uint32_t>{
        1, static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32), 0, 0, 0, 0};
  };
  for (const int bits : {PixelSums::kColorBits, PixelSums::kSquareBits}) {
    const int64_t most = int64_t{1} << (bits - 2);
    PixelSums sums(2, bits), same_steps(2, bits);
    for (const int64_t carry : {most + 1, -most - 1, std::numeric_limits<int64_t>::min()})
      EXPECT_THROW(sums.load_carries(words(carry)), IoError) << bits;
    sums.load_carries(words(-most));
    EXPECT_EQ(red(sums, 1), -0x1p62);
    EXPECT_TRUE(same_steps.add(1, sums));
    EXPECT_FALSE(same_steps.add(1, sums));
    EXPECT_EQ(red(same_steps, 1), -0x1p62);
  }
}

TEST(PixelSums, TakesAnySumOfColours) {
  PixelSums sums(1);
  RgbSum least;
  least.rgb[0].bits = FixedSum::Bits{1} << 127;
  EXPECT_FALSE(sums.add(0, least));
  EXPECT_EQ(red(sums, 0), -0x1p62);
}

TEST(PixelSums, ThreadsMayUseDifferentPixels) {
  constexpr size_t kPixels = 1000;
  PixelSums sums(kPixels);
  const std::vector<Rgb> values = colors(kPixels);
  parallel_chunks(kPixels, 10, [&](int64_t, int64_t begin, int64_t end) {
    for (auto i = static_cast<size_t>(begin); i < static_cast<size_t>(end); ++i)
      for (int k = 0; k < 100; ++k) sums.add(i, values[i]);
  });
  for (size_t i = 0; i < kPixels; ++i) {
    PixelSums one(1);
    for (int k = 0; k < 100; ++k) one.add(0, values[i]);
    EXPECT_EQ(sums.sum(i).rgb[1].bits, one.sum(0).rgb[1].bits) << i;
  }
}

}  // namespace
}  // namespace nephroid
