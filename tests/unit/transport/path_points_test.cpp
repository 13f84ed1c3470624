// The Sobol' dimensions of a path's decisions.
#include "transport/path_points.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "transport/walk.h"

namespace nephroid {
namespace {

TEST(PathPoints, EveryDimensionIsDealtOnce) {
  std::set<int> eye, all;
  for (int d = 0; d < kEyePathDimensions; ++d) eye.insert(dimension_of(d));
  EXPECT_EQ(eye.size(), static_cast<size_t>(kEyePathDimensions));
  // Further numbers of a camera path keep their own dimensions.
  EXPECT_EQ(*eye.rbegin(), kEyePathDimensions - 1);
  for (int d = 0; d < kPairDimensions; ++d) all.insert(dimension_of(d));
  EXPECT_EQ(all.size(), static_cast<size_t>(kPairDimensions));
  EXPECT_GE(*all.begin(), 0);
  EXPECT_LT(*all.rbegin(), kSobolDimensions);
}

TEST(PathPoints, HaveTheNumbersOfThoseDimensions) {
  const SobolPoint dealt = eye_point(77), plain(77), few = eye_point(77, 8);
  for (int d = 0; d < kSobolDimensions; ++d)
    EXPECT_EQ(dealt.reversed(d), plain.reversed(d < kEyePathDimensions ? dimension_of(d) : d));
  EXPECT_EQ(few.dimensions(), 8);
  for (int d = 0; d < 8; ++d) EXPECT_EQ(few.reversed(d), dealt.reversed(d));
  const SobolPoint light = light_point(77);
  EXPECT_EQ(light.dimensions(), kPairDimensions);
  for (int d = kEyePathDimensions; d < kPairDimensions; ++d)
    EXPECT_EQ(light.reversed(d), plain.reversed(dimension_of(d)));
}

/// [U1] of two decisions relative to the sequence's first two dimensions, mean over runs of 2^4 to
/// 2^12 points.
double unevenness(int first, int second) {
  const auto factor = [](const SobolPoint& p, int d) {
    const double rest = std::ldexp(1.0, -std::countr_zero(p.reversed(d)));
    return 1 + (1 - rest) - 0.5 * rest;
  };
  double sum = 0;
  for (int log2 = 4; log2 <= 12; ++log2) {
    double pair = 0, ideal = 0;
    for (uint32_t i = 0; i < 1u << log2; ++i) {
      const SobolPoint dealt = light_point(i), plain(i, 2);
      pair += factor(dealt, first) * factor(dealt, second);
      ideal += factor(plain, 0) * factor(plain, 1);
    }
    const double n = std::ldexp(1.0, log2);
    sum += (pair / n - 1) / (ideal / n - 1);
  }
  return sum / 9;
}

// In the sequence's own order, the directions of the second and third vertex have 16 and 13.
TEST(PathPoints, DecisionsOfTwoNumbersAreNearlyAsEvenAsCanBe) {
  EXPECT_NEAR(unevenness(dimensions::kFilm, dimensions::kFilm + 1), 1, 1e-12);
  for (int vertex = 0; vertex < 11; ++vertex) {
    const int at = vertex == 0 ? dimensions::kFirstVertex
                               : dimensions::kSecondVertex + (vertex - 1) * dimensions::kPerVertex;
    for (const int decision : {dimensions::kLight + 1, dimensions::kBsdf + 1})
      EXPECT_LT(unevenness(at + decision, at + decision + 1), vertex < 2 ? 2.0 : 2.6)
          << "vertex " << vertex << ", decision " << decision;
  }
  // Point and direction of the light, then its vertices. In the sequence's own order up to 12.
  EXPECT_LT(unevenness(kEyePathDimensions + 1, kEyePathDimensions + 2), 2.5);
  EXPECT_LT(unevenness(kEyePathDimensions + 3, kEyePathDimensions + 4), 2.5);
  for (int vertex = 0; vertex < 5; ++vertex) {
    const int at = kEyePathDimensions + 5 + vertex * dimensions::kPerVertex + dimensions::kBsdf + 1;
    EXPECT_LT(unevenness(at, at + 1), 2.5) << "vertex " << vertex << " of the light's";
  }
}

}  // namespace
}  // namespace nephroid
