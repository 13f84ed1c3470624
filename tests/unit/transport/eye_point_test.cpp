// Which dimensions of the Sobol' sequence the decisions of a camera path have.
#include "transport/eye_point.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "transport/walk.h"

namespace nephroid {
namespace {

TEST(EyePoint, EveryDimensionIsDealtOnce) {
  std::set<int> dimensions;
  for (int d = 0; d < kEyePathDimensions; ++d) dimensions.insert(eye_dimension(d));
  EXPECT_EQ(dimensions.size(), static_cast<size_t>(kEyePathDimensions));
  EXPECT_EQ(*dimensions.begin(), 0);
  EXPECT_EQ(*dimensions.rbegin(), kEyePathDimensions - 1);
}

TEST(EyePoint, HasTheNumbersOfThoseDimensions) {
  const SobolPoint dealt = eye_point(77), plain(77), few = eye_point(77, 8);
  for (int d = 0; d < kSobolDimensions; ++d)
    EXPECT_EQ(dealt.reversed(d), plain.reversed(d < kEyePathDimensions ? eye_dimension(d) : d));
  EXPECT_EQ(few.dimensions(), 8);
  for (int d = 0; d < 8; ++d) EXPECT_EQ(few.reversed(d), dealt.reversed(d));
}

/// [N1] of two decisions, over what the first two dimensions of the sequence have: mean over runs
/// of 2^4 to 2^12 points.
double unevenness(int first, int second) {
  const auto factor = [](const SobolPoint& p, int d) {
    const double rest = std::ldexp(1.0, -std::countr_zero(p.reversed(d)));
    return 1 + (1 - rest) - 0.5 * rest;
  };
  double sum = 0;
  for (int log2 = 4; log2 <= 12; ++log2) {
    double pair = 0, ideal = 0;
    for (uint32_t i = 0; i < 1u << log2; ++i) {
      const SobolPoint dealt = eye_point(i, kEyePathDimensions), plain(i, 2);
      pair += factor(dealt, first) * factor(dealt, second);
      ideal += factor(plain, 0) * factor(plain, 1);
    }
    const double n = std::ldexp(1.0, log2);
    sum += (pair / n - 1) / (ideal / n - 1);
  }
  return sum / 9;
}

// In the order of the sequence the directions of the second and third vertex had 16 and 13.
TEST(EyePoint, DecisionsOfTwoNumbersAreNearlyAsEvenAsCanBe) {
  EXPECT_NEAR(unevenness(dimensions::kFilm, dimensions::kFilm + 1), 1, 1e-12);
  for (int vertex = 0; vertex < 5; ++vertex) {
    const int at = vertex == 0 ? dimensions::kFirstVertex
                               : dimensions::kSecondVertex + (vertex - 1) * dimensions::kPerVertex;
    for (const int decision : {dimensions::kLight + 1, dimensions::kBsdf + 1})
      EXPECT_LT(unevenness(at + decision, at + decision + 1), vertex < 2 ? 1.8 : 2.5)
          << "vertex " << vertex << ", decision " << decision;
  }
}

}  // namespace
}  // namespace nephroid
