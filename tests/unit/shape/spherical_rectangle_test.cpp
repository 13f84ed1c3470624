// Solid angles of near and far rectangles: exact where a closed form exists, and never inflated by
// rounding.
#include "scene/shape/spherical_rectangle.h"

#include <gtest/gtest.h>

#include "core/sampler.h"

namespace nephroid {
namespace {

const RectangleFrame kUnit(Vec3d(-0.5, -0.5, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0));

TEST(SphericalRectangle, AboveTheCentre) {
  for (const double h : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    const double exact = 4 * std::asin(0.25 / (0.25 + h * h));
    EXPECT_NEAR(SphericalRectangle(Vec3d(0, 0, h), kUnit).solid_angle(), exact,
                1e-9 * exact + 1e-13)
        << h;
  }
}

TEST(SphericalRectangle, RoundingNeverMakesItHuge) {
  for (const double distance : {1e3, 1e5, 1e7, 1e8, 1e10}) {
    for (uint64_t i = 0; i < 20000; ++i) {
      const auto u = [&](uint64_t k) {
        return 2.0 * bits_to_unit_float(static_cast<uint32_t>(hash_combine(i, k) >> 32)) - 1.0;
      };
      // Anywhere, or close to the rectangle's plane.
      const Vec3d from(distance * (1.0 + u(0)), distance * u(1),
                       (i % 2 ? distance : 1e-6) * (u(2) + 1.5));
      const double omega = SphericalRectangle(from, kUnit).solid_angle();
      EXPECT_LT(omega, 2.0 / std::max(1.0, (from - Vec3d(0, 0, 0)).length()) + 1e-9)
          << from.x << ' ' << from.y << ' ' << from.z;
    }
  }
}

}  // namespace
}  // namespace nephroid
