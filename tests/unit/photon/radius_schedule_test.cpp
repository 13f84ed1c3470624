// Equations [E1] and [E2] on small examples, and their convergence.
#include "photon/radius_schedule.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

TEST(RadiusSchedule, MemorylessFormEqualsTheRecurrence) {
  const double alpha = 2.0 / 3.0;
  double r2 = 1;
  for (uint32_t pass = 0; pass < 5000; ++pass) {
    const double i = pass + 1.0;
    EXPECT_NEAR(memoryless_radius_squared(pass, alpha) / r2, 1.0, 1e-9);
    r2 *= (i + alpha) / (i + 1);
  }
}

TEST(RadiusSchedule, MemorylessShrinksAsKnausAndZwickerSay) {
  // r^2(i) ~ i^(alpha - 1): a factor 8 of passes halves r^2 for alpha = 2/3.
  const double ratio =
      memoryless_radius_squared(79999, 2.0 / 3) / memoryless_radius_squared(9999, 2.0 / 3);
  EXPECT_NEAR(ratio, 0.5, 1e-4);
}

TEST(RadiusSchedule, SharedStatisticsByHand) {
  SharedStatistics s;
  s.radius_squared = 4;
  EXPECT_DOUBLE_EQ(s.update(6, 0.5), 0.5);  // N' = 3, ratio 3/6
  EXPECT_DOUBLE_EQ(s.count, 3);
  EXPECT_DOUBLE_EQ(s.radius_squared, 2);
  EXPECT_DOUBLE_EQ(s.update(6, 0.5), 6.0 / 9);  // N' = 6, ratio 6/9
  EXPECT_DOUBLE_EQ(s.count, 6);
  EXPECT_NEAR(s.radius_squared, 4.0 / 3, 1e-12);
}

TEST(RadiusSchedule, PassWithoutPhotonsKeepsTheRadius) {
  SharedStatistics s;
  s.radius_squared = 4;
  EXPECT_DOUBLE_EQ(s.update(0, 0.5), 1);
  EXPECT_DOUBLE_EQ(s.radius_squared, 4);
  EXPECT_DOUBLE_EQ(s.count, 0);
}

TEST(RadiusSchedule, OneDimensionalDensityConverges) {
  // Hachisuka & Jensen's one-dimensional validation, in the plane: photons of density 2x on the
  // unit square, gathered at one point. The estimate tends to the density there, and the radius
  // keeps shrinking.
  SharedStatistics s;
  s.radius_squared = 0.04;
  uint64_t n = 0;
  double emitted = 0, tau = 0;
  const double x0 = 0.5, y0 = 0.5;
  for (int pass = 0; pass < 400; ++pass) {
    double found = 0;
    for (int i = 0; i < 2000; ++i) {
      // A two-dimensional golden ratio sequence, with x warped to density 2x.
      ++n;
      const double u = std::fmod(0.5 + static_cast<double>(n) * 0.7548776662466927, 1.0);
      const double v = std::fmod(0.5 + static_cast<double>(n) * 0.5698402909980532, 1.0);
      const double x = std::sqrt(u);
      if ((x - x0) * (x - x0) + (v - y0) * (v - y0) <= s.radius_squared) ++found;
    }
    emitted += 2000;
    tau = (tau + found) * s.update(found, 2.0 / 3);
  }
  EXPECT_LT(s.radius_squared, 0.01);
  EXPECT_NEAR(tau / (emitted * 3.14159265358979 * s.radius_squared), 1.0, 0.02);
}

}  // namespace
}  // namespace nephroid
