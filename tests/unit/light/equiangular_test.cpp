// Distances by equal angles: the density integrates to one and is that of the samples, and the
// piece of the ray is the one inside the light's cone.
#include "scene/light/equiangular.h"

#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

struct EquiangularCase {
  const char* name;
  Ray ray;
  float t_max;
  LightPlace light;
};

Ray ray_between(const Vec3f& from, const Vec3f& towards) {
  return {from, normalize(towards - from), kInfinity, 0};
}

LightPlace cone(const Vec3f& apex, const Vec3f& axis, float degrees) {
  LightPlace place;
  place.center = apex;
  place.axis = normalize(axis);
  place.cos_cone = std::cos(degrees * kPi / 180);
  return place;
}
LightPlace ball(const Vec3f& center, float radius) {
  LightPlace place;
  place.center = center;
  place.radius2 = radius * radius;
  return place;
}

const std::vector<EquiangularCase> kCases = {
    {"point beside", ray_between({0, 0, 0}, {1, 0, 0}), 5, ball({2, 1, 0}, 0)},
    {"point behind", ray_between({0, 0, 0}, {1, 0, 0}), 5, ball({-3, 1, 2}, 0)},
    {"close point", ray_between({0, 0, 0}, {1, 0, 0}), 5, ball({2, 0.01f, 0}, 0)},
    {"endless", ray_between({0, 0, 0}, {1, 2, 0}), kInfinity, ball({2, 1, 0}, 0)},
    {"through a ball", ray_between({0, 0, 0}, {1, 0, 0}), 5, ball({2, 0.1f, 0}, 0.5f)},
    {"across a cone", ray_between({-4, 0, 1}, {4, 0.1f, 1}), 9, cone({0, 0, 3}, {0, 0, -1}, 20)},
    {"from inside", ray_between({0, 0, 1}, {4, 1, 1}), 9, cone({0, 0, 3}, {0, 0, -1}, 30)},
    {"into a cone", ray_between({1, 0, 4}, {0.2f, 0, 0}), kInfinity,
     cone({0, 0, 3}, {0, 0, -1}, 40)},
    {"out of a cone", ray_between({0.2f, 0, 0}, {1, 0, 4}), 9, cone({0, 0, 3}, {0, 0, -1}, 40)},
    {"wide cone", ray_between({-3, 1, 3.2f}, {4, 0, 2}), 20, cone({0, 0, 3}, {0, 0, -1}, 80)},
};

TEST(Equiangular, DensityIsThatOfTheSamples) {
  TestRandom random(3);
  for (const EquiangularCase& c : kCases) {
    const Equiangular e(c.ray, c.t_max, c.light);
    ASSERT_GT(e.importance(), 0) << c.name;
    // In t / (1 + t), so that endless rays fit.
    constexpr int kBins = 40, kSteps = 500, kCount = 40000;
    std::vector<double> observed(kBins), expected(kBins);
    double sum = 0;
    const double whole = c.t_max < kInfinity ? c.t_max / (1.0 + c.t_max) : 1.0;
    for (int i = 0; i < kBins * kSteps; ++i) {
      const double x = (i + 0.5) * whole / (kBins * kSteps), t = x / (1 - x);
      const double share = e.pdf(static_cast<float>(t)) / sqr(1 - x) * whole / (kBins * kSteps);
      expected[i / kSteps] += kCount * share;
      sum += share;
    }
    EXPECT_NEAR(sum, 1, 2e-3) << c.name;
    for (int i = 0; i < kCount; ++i) {
      const float t = e.sample(random.next());
      ASSERT_TRUE(t >= 0 && t <= c.t_max) << c.name;
      ++observed[std::min(static_cast<int>(t / (1 + t) / whole * kBins), kBins - 1)];
    }
    for (double& x : expected) x /= sum;
    EXPECT_GT(chi_square_test(observed, expected), 1e-4) << c.name;
  }
}

TEST(Equiangular, APieceFarFromTheLightIsEven) {
  for (const float distance : {1e4f, 1e8f}) {
    const Equiangular e(ray_between({0, 0, 0}, {1, 0, 0}), 2,
                        ball({distance, 1.5f * distance, 0}, 0));
    EXPECT_NEAR(e.importance() * sqr(distance) * 3.25f / 2, 1, 1e-3);
    for (const float u : {0.0f, 0.1f, 0.5f, 0.9f}) {
      EXPECT_NEAR(e.sample(u), 2 * u, 2e-3) << distance;
      EXPECT_NEAR(e.pdf(2 * u), 0.5, 1e-3) << distance;
    }
  }
}

TEST(Equiangular, PieceIsThatInsideTheCone) {
  for (const EquiangularCase& c : kCases) {
    if (!(c.light.cos_cone > 0)) continue;
    const Equiangular e(c.ray, c.t_max, c.light);
    int inside = 0, outside = 0;
    for (int i = 0; i < 1000; ++i) {
      const float t = (static_cast<float>(i) + 0.5f) * 0.009f;
      const Vec3f w = normalize(c.ray.o + c.ray.d * t - c.light.center);
      const float off = dot(w, c.light.axis) - c.light.cos_cone;
      if (std::abs(off) < 1e-4f) continue;
      EXPECT_EQ(e.pdf(t) > 0, off > 0) << c.name << ", t " << t;
      ++(off > 0 ? inside : outside);
    }
    EXPECT_GT(inside, 10) << c.name;
    EXPECT_GT(outside, 10) << c.name;
  }
}

TEST(Equiangular, NothingWhereTheLightDoesNotShine) {
  const LightPlace down = cone({0, 0, 3}, {0, 0, -1}, 20);
  for (const Ray& ray : {ray_between({-4, 0, 5}, {4, 0, 5}), ray_between({-4, 3, 2}, {4, 3, 2}),
                         ray_between({0, 0, 4}, {0.1f, 0, 9})})
    EXPECT_EQ(Equiangular(ray, 8, down).importance(), 0);
  // Cut off before the cone.
  EXPECT_EQ(Equiangular(ray_between({-4, 0, 1}, {4, 0, 1}), 2, down).importance(), 0);
}

TEST(Equiangular, ARayThroughTheLightIsFinite) {
  for (const LightPlace& light : {ball({2, 0, 0}, 0), ball({0, 0, 0}, 0),
                                  cone({2, 0, 0}, {1, 0, 0}, 30), cone({2, 0, 0}, {0, 0, 1}, 30)}) {
    const Equiangular e(ray_between({0, 0, 0}, {1, 0, 0}), 5, light);
    EXPECT_TRUE(std::isfinite(e.importance()));
    if (!(e.importance() > 0)) continue;
    for (const float u : {0.0f, 0.3f, 0.999f}) {
      EXPECT_TRUE(std::isfinite(e.sample(u)));
      EXPECT_TRUE(std::isfinite(e.pdf(e.sample(u))));
    }
  }
}

}  // namespace
}  // namespace nephroid::testing_light
