// The accumulator against __int128 arithmetic, and its guarantees: exact, independent of order,
// rounded to the nearest step, clamped to its limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/sampler.h"
#include "film/film.h"

namespace nephroid {
namespace {

constexpr double kStep = 0x1p-64;

__extension__ using Wide = __int128;

FixedSum sum_of(const std::vector<double>& values) {
  FixedSum sum;
  for (const double v : values) sum.add(v);
  return sum;
}

/// Doubles of many magnitudes and both signs.
std::vector<double> spread_values(size_t count) {
  std::vector<double> values;
  for (size_t i = 0; i < count; ++i) {
    const uint64_t bits = mix_bits(i + 1);
    const double mantissa = static_cast<double>(bits >> 11) * 0x1p-53 - 0.5;
    const int exponent = static_cast<int>(mix_bits(bits) % 80) - 50;
    values.push_back(std::ldexp(mantissa, exponent));
  }
  return values;
}

TEST(FixedSum, BitsCountStepsOfTwoToMinus64) {
  FixedSum sum;
  EXPECT_TRUE(sum.add(1.0));
  EXPECT_EQ(sum.bits, Wide{1} << 64);
  EXPECT_TRUE(sum.add(-0.25));
  EXPECT_EQ(sum.bits, (Wide{1} << 64) - (Wide{1} << 62));
  EXPECT_EQ(sum.value(), 0.75);
  EXPECT_TRUE(sum.add(kStep));
  EXPECT_EQ(sum.bits, (Wide{1} << 64) - (Wide{1} << 62) + 1);
}

TEST(FixedSum, AnyOrderHasTheSameBits) {
  std::vector<double> values = spread_values(5000);
  const FixedSum forward = sum_of(values);
  std::reverse(values.begin(), values.end());
  EXPECT_EQ(sum_of(values).bits, forward.bits);
  std::sort(values.begin(), values.end(),
            [](double a, double b) { return std::abs(a) < std::abs(b); });
  EXPECT_EQ(sum_of(values).bits, forward.bits);
  // Partial sums, added afterwards.
  FixedSum parts[7], total;
  for (size_t i = 0; i < values.size(); ++i) parts[i % 7].add(values[i]);
  for (const FixedSum& part : parts) EXPECT_TRUE(total.add(part));
  EXPECT_EQ(total.bits, forward.bits);
}

TEST(FixedSum, ManySmallOnTopOfOneLargeLoseNothing) {
  FixedSum sum;
  sum.add(1e15);
  for (int i = 0; i < 1000; ++i) sum.add(0x1p-40);
  sum.add(-1e15);
  EXPECT_EQ(sum.value(), 1000 * 0x1p-40);
}

TEST(FixedSum, WhatIsTakenAwayAgainLeavesNothing) {
  FixedSum sum;
  for (const double v : spread_values(1000)) {
    sum.add(v);
    sum.add(-v);
  }
  EXPECT_EQ(sum.bits, 0);
}

TEST(FixedSum, RoundsToTheNearestStepTiesToEven) {
  const struct {
    double value;
    int steps;
  } cases[] = {{0.5 * kStep, 0},
               {std::nextafter(0.5, 1.0) * kStep, 1},
               {std::nextafter(0.5, 0.0) * kStep, 0},
               {0.75 * kStep, 1},
               {1.5 * kStep, 2},
               {2.5 * kStep, 2},
               {2.25 * kStep, 2},
               {2.75 * kStep, 3},
               {3.5 * kStep, 4},
               {0.25 * kStep, 0},
               {1e-300, 0},
               {std::numeric_limits<double>::denorm_min(), 0}};
  for (const auto& c : cases) {
    FixedSum plus, minus;
    EXPECT_TRUE(plus.add(c.value));
    EXPECT_TRUE(minus.add(-c.value));
    EXPECT_EQ(static_cast<int>(plus.bits), c.steps) << c.value / kStep;
    EXPECT_EQ(static_cast<int>(minus.bits), -c.steps) << c.value / kStep;
  }
}

TEST(FixedSum, RoundingErrorIsAtMostHalfAStepEach) {
  for (int i = 0; i < 20000; ++i) {
    const uint64_t bits = mix_bits(static_cast<uint64_t>(i) + 77);
    const double value =
        std::ldexp(static_cast<double>(bits >> 11), -64 - static_cast<int>(bits % 53));
    FixedSum sum;
    ASSERT_TRUE(sum.add(value));
    // Both are below 2^53 steps, which doubles hold exactly.
    const double steps = static_cast<double>(static_cast<int64_t>(sum.bits));
    ASSERT_LE(std::abs(steps - value * 0x1p64), 0.5) << i;
  }
}

TEST(FixedSum, NotFiniteIsRefusedAndChangesNothing) {
  FixedSum sum;
  sum.add(2.0);
  EXPECT_FALSE(sum.add(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(sum.add(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(sum.add(-std::numeric_limits<double>::infinity()));
  EXPECT_EQ(sum.value(), 2.0);
}

TEST(FixedSum, HoldsTheLargestValuesAndSaturatesBeyond) {
  const double largest = std::nextafter(0x1p63, 0.0);
  FixedSum sum;
  EXPECT_TRUE(sum.add(largest));
  EXPECT_EQ(sum.value(), largest);
  EXPECT_FALSE(sum.add(largest));
  EXPECT_EQ(sum.value(), 0x1p63);  // the limit, rounded to a double
  const Wide limit = sum.bits;
  EXPECT_FALSE(sum.add(1.0));
  EXPECT_EQ(sum.bits, limit);

  FixedSum negative;
  EXPECT_FALSE(negative.add(-0x1p63));
  EXPECT_EQ(negative.bits, -limit);
  EXPECT_FALSE(negative.add(-1e300));
  EXPECT_EQ(negative.bits, -limit);
  EXPECT_FALSE(negative.add(FixedSum{-limit}));
  EXPECT_EQ(negative.bits, -limit);
  EXPECT_TRUE(negative.add(FixedSum{limit}));
  EXPECT_EQ(negative.bits, 0);
}

TEST(FixedSum, ValueIsRoundedToNearestOnce) {
  // 2^53 + 1 lies between two doubles. With a little more it is closer to the upper one.
  FixedSum sum;
  sum.add(0x1p53);
  sum.add(1.0);
  EXPECT_EQ(sum.value(), 0x1p53);
  sum.add(kStep);
  EXPECT_EQ(sum.value(), 0x1p53 + 2);
}

}  // namespace
}  // namespace nephroid
