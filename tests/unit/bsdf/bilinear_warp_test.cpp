// Bilinear warps: normalisation, chi-square, inverse, mixtures of grids, and degenerate grids from
// files.
#include "scene/bsdf/bilinear_warp.h"

#include <gtest/gtest.h>

#include "unit/bsdf/statistics.h"

namespace nephroid::testing_bsdf {
namespace {

/// Three grids of 5 x 4 nodes with zeros, peaks and flat parts.
GridFamily three_grids() {
  GridFamily family{5, 4, {}};
  TestRandom random(1);
  for (int g = 0; g < 3; ++g)
    for (int i = 0; i < 20; ++i)
      family.values.push_back(i % 7 == g ? 0.0f : i % 5 == 2 ? 20.0f * random.next() : 1.0f);
  return family;
}

GridMix mix_of(std::initializer_list<std::pair<size_t, float>> parts) {
  GridMix mix;
  for (const auto& [grid, weight] : parts) mix.add(grid, weight);
  return mix;
}

/// The middle of bin i of `side` x `side`, counted along rows.
Vec2f middle(size_t i, size_t side) {
  const double step = 1.0 / static_cast<double>(side);
  return {static_cast<float>((static_cast<double>(i % side) + 0.5) * step),
          static_cast<float>((static_cast<double>(i / side) + 0.5) * step)};
}

TEST(BilinearWarp, DensityIntegratesToOneAndIsProportional) {
  const GridFamily family = three_grids();
  const BilinearWarp warp(family);
  const GridMix only = mix_of({{1, 1.0f}});
  double sum = 0.0;
  constexpr size_t kSteps = 120;
  for (size_t i = 0; i < kSteps * kSteps; ++i)
    sum += static_cast<double>(warp.density(middle(i, kSteps), only));
  // The midpoint rule is exact for bins inside a cell.
  EXPECT_NEAR(sum / (kSteps * kSteps), 1.0, 1e-4);
  const float scale = warp.density({0, 0}, only) / family.values[20];
  for (size_t y = 0; y < 4; ++y)
    for (size_t x = 0; x < 5; ++x)
      EXPECT_NEAR(warp.density({static_cast<float>(x) / 4, static_cast<float>(y) / 3}, only),
                  family.values[20 + y * 5 + x] * scale, 1e-4f);
}

TEST(BilinearWarp, SamplesFollowTheDensityOfAMixture) {
  const BilinearWarp warp(three_grids());
  const GridMix mix = mix_of({{0, 0.2f}, {2, 0.8f}});
  constexpr size_t kBins = 12, kCount = 100000;
  std::vector<double> observed(kBins * kBins, 0.0), expected(kBins * kBins, 0.0);
  TestRandom random(2);
  for (size_t i = 0; i < kCount; ++i) {
    const Vec2f p = warp.sample(random.next2(), mix).p;
    const size_t x = std::min(kBins - 1, static_cast<size_t>(p.x * kBins));
    const size_t y = std::min(kBins - 1, static_cast<size_t>(p.y * kBins));
    observed[y * kBins + x] += 1.0;
  }
  // Bins lie inside cells (12 is a multiple of 4 and 3), where the midpoint rule is exact.
  const auto p_value_against = [&](const GridMix& stated) {
    for (size_t i = 0; i < expected.size(); ++i)
      expected[i] =
          static_cast<double>(warp.density(middle(i, kBins), stated)) * kCount / (kBins * kBins);
    return chi_square_test(observed, expected);
  };
  EXPECT_GT(p_value_against(mix), 1e-3);
  EXPECT_LT(p_value_against(mix_of({{2, 1.0f}})), 1e-6) << "the test cannot fail";
}

TEST(BilinearWarp, InverseLeadsBack) {
  const BilinearWarp warp(three_grids());
  TestRandom random(4);
  for (const GridMix& mix : {mix_of({{1, 1.0f}}), mix_of({{0, 0.5f}, {1, 0.25f}, {2, 0.25f}})}) {
    for (int i = 0; i < 20000; ++i) {
      const Vec2f u = random.next2();
      const BilinearWarp::Point there = warp.sample(u, mix);
      const BilinearWarp::Point back = warp.invert(there.p, mix);
      EXPECT_NEAR(back.p.x, u.x, 2e-5f);
      EXPECT_NEAR(back.p.y, u.y, 2e-5f);
      EXPECT_NEAR(back.density, there.density, 1e-4f * there.density + 2e-4f);
      EXPECT_NEAR(warp.density(there.p, mix), back.density, 1e-4f * back.density + 1e-6f);
    }
  }
}

TEST(BilinearWarp, CornersStayInTheSquare) {
  const BilinearWarp warp(three_grids());
  const GridMix mix = mix_of({{0, 1.0f}});
  for (const float x : {0.0f, 1e-30f, 0.5f, kOneMinusEpsilon, 1.0f}) {
    for (const float y : {0.0f, 1e-30f, 0.5f, kOneMinusEpsilon, 1.0f}) {
      for (const BilinearWarp::Point& p : {warp.sample({x, y}, mix), warp.invert({x, y}, mix)}) {
        EXPECT_TRUE(p.p.x >= 0.0f && p.p.x <= 1.0f && p.p.y >= 0.0f && p.p.y <= 1.0f);
        EXPECT_TRUE(p.density >= 0.0f && std::isfinite(p.density));
      }
    }
  }
}

TEST(BilinearWarp, NothingIsUniformAndNegativeIsNothing) {
  const BilinearWarp warp({2, 2, {0, 0, 0, 0, 1, -1, 1, -1}});
  TestRandom random(6);
  for (int i = 0; i < 100; ++i) {
    const Vec2f u = random.next2();
    const BilinearWarp::Point flat = warp.sample(u, mix_of({{0, 1.0f}}));
    EXPECT_NEAR(flat.p.x, u.x, 1e-6f);
    EXPECT_NEAR(flat.density, 1.0f, 1e-6f);
    // Density 2 (1 - x): the inverse of its distribution is 1 - sqrt(1 - u).
    const BilinearWarp::Point ramp = warp.sample(u, mix_of({{1, 1.0f}}));
    EXPECT_NEAR(ramp.p.x, 1.0f - std::sqrt(1.0f - u.x), 1e-5f);
    EXPECT_NEAR(ramp.density, 2.0f * (1.0f - ramp.p.x), 1e-5f);
  }
}

TEST(ParameterAxis, FindsNeighboursAndEnds) {
  const ParameterAxis axis({1.0f, 2.0f, 4.0f});
  EXPECT_EQ(axis.find(0.0f).upper, 0u);
  EXPECT_EQ(axis.find(5.0f).lower, 2u);
  EXPECT_EQ(axis.find(3.0f).lower, 1u);
  EXPECT_EQ(axis.find(3.0f).upper, 2u);
  EXPECT_FLOAT_EQ(axis.find(3.0f).t, 0.5f);
  EXPECT_EQ(ParameterAxis({7.0f}).find(3.0f).upper, 0u);
}

}  // namespace
}  // namespace nephroid::testing_bsdf
