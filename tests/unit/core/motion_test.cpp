// Moving transforms with known results: keyframes, constant angular speed, straight paths, and
// bounds that contain every sampled point.
#include "core/motion.h"

#include <gtest/gtest.h>

#include "core/sampler.h"

namespace nephroid {
namespace {

struct Numbers {
  uint64_t state;
  double operator()() {
    return bits_to_unit_float(
        static_cast<uint32_t>(mix_bits(++state * 0x9e3779b97f4a7c15ull) >> 32));
  }
  double centred() { return 2 * (*this)() - 1; }
};

Mat44d rotation(double degrees, const Vec3d& axis) {
  Mat44d m;
  m.setAxisAngle(axis.normalized(), degrees * 3.14159265358979323846 / 180);
  return m;
}
Mat44d scaling(double x, double y, double z) {
  Mat44d m;
  m[0][0] = x, m[1][1] = y, m[2][2] = z;
  return m;
}
Mat44d translation(double x, double y, double z) {
  Mat44d m;
  m[3][0] = x, m[3][1] = y, m[3][2] = z;
  return m;
}
/// An arbitrary affine matrix: shear, unequal scales, mirrored or not, far away.
Mat44d random_matrix(Numbers& u, bool mirror) {
  Mat44d m = rotation(360 * u(), Vec3d(u.centred(), u.centred(), u.centred() + 1e-3)) *
             scaling(0.1 + 3 * u(), 0.1 + 3 * u(), 0.1 + 3 * u()) *
             rotation(360 * u(), Vec3d(u.centred(), u.centred() + 1e-3, u.centred())) *
             translation(10 * u.centred(), 10 * u.centred(), 10 * u.centred());
  return mirror ? scaling(-1, 1, 1) * m : m;
}

Vec3d apply(const Mat44d& m, const Vec3d& p) {
  Vec3d out;
  for (int j = 0; j < 3; ++j) out[j] = p.x * m[0][j] + p.y * m[1][j] + p.z * m[2][j] + m[3][j];
  return out;
}
double difference(const Mat44d& a, const Mat44d& b) {
  double most = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) most = std::max(most, std::abs(a[i][j] - b[i][j]));
  return most;
}

TEST(Motion, EqualKeyframesDoNotMove) {
  Numbers u{1};
  const Mat44d m = random_matrix(u, false);
  EXPECT_FALSE(MotionTransform().moves());
  EXPECT_FALSE(MotionTransform(m).moves());
  EXPECT_FALSE(MotionTransform(m, m).moves());
  EXPECT_EQ(MotionTransform(m).at(0.3f).m, m);
  EXPECT_EQ(MotionTransform(m).segments(), 1);
  EXPECT_TRUE(MotionTransform(m, translation(1, 0, 0)).moves());
}

TEST(Motion, IsExactAtTheKeyframesAndContinuousThere) {
  Numbers u{2};
  for (int i = 0; i < 200; ++i) {
    const bool mirror = i % 2;
    const Mat44d a = random_matrix(u, mirror), b = random_matrix(u, mirror);
    const MotionTransform t(a, b, Vec3d(u(), u(), u()) * 20.0);
    EXPECT_EQ(t.at(0.0f).m, a);
    EXPECT_EQ(t.at(-1.0f).m, a);
    EXPECT_EQ(t.at(std::numeric_limits<float>::quiet_NaN()).m, a);
    EXPECT_EQ(t.at(1.0f).m, b);
    EXPECT_EQ(t.at(2.0f).m, b);
    EXPECT_LT(difference(t.at(1e-9f).m, a), 1e-6);
    EXPECT_LT(difference(t.at(kOneMinusEpsilon).m, b), 1e-4);
    const Transform half = t.at(0.5f);
    EXPECT_LT(difference(half.m * half.inverse, Mat44d()), 1e-9);
    EXPECT_EQ(half.swaps_handedness(), mirror);
  }
}

TEST(Motion, RotationsTurnAtConstantSpeedTheShortWay) {
  Numbers u{3};
  for (int i = 0; i < 200; ++i) {
    const Vec3d axis(u.centred(), u.centred(), u.centred() + 1e-3);
    const Mat44d base = random_matrix(u, false);
    // Keyframes S R0 and S R0 R(angle): the stretch stays, and the rotation is about a world axis.
    for (const double degrees : {0.01, 1.0, 90.0, 170.0, 179.9, -179.9}) {
      Mat44d linear = base;
      for (int j = 0; j < 3; ++j) linear[3][j] = 0;
      const MotionTransform t(linear, linear * rotation(degrees, axis));
      for (const float time : {0.1f, 0.5f, 0.8f})
        EXPECT_LT(difference(t.at(time).m, linear * rotation(degrees * double(time), axis)), 1e-10);
    }
    // Beyond half a turn the other way is shorter.
    const MotionTransform t(Mat44d(), rotation(200, axis));
    EXPECT_LT(difference(t.at(0.25f).m, rotation(-40, axis)), 1e-10);
  }
}

// As in pbrt-v4, whose float sine of 180 degrees is negative.
TEST(Motion, AHalfTurnAboutACoordinateAxisGoesClockwise) {
  for (int i = 0; i < 3; ++i) {
    Vec3d axis(0, 0, 0);
    axis[i] = 1;
    const MotionTransform t(Mat44d(), rotation(180, axis));
    EXPECT_LT(difference(t.at(0.5f).m, rotation(-90, axis)), 1e-9);
    const MotionTransform turned(rotation(60, Vec3d(1, 1, 1)),
                                 rotation(180, axis) * rotation(60, Vec3d(1, 1, 1)));
    EXPECT_LT(difference(turned.at(0.5f).m, rotation(-90, axis) * rotation(60, Vec3d(1, 1, 1))),
              1e-9);
  }
}

TEST(Motion, TranslationAndStretchAreLinear) {
  const MotionTransform t(scaling(1, 2, 3) * translation(1, 0, 0),
                          scaling(3, 2, 1) * translation(0, 4, 0));
  EXPECT_LT(difference(t.at(0.25f).m, scaling(1.5, 2, 2.5) * translation(0.75, 1, 0)), 1e-14);
  // A mirrored object stays mirrored; it does not turn inside out.
  const MotionTransform mirrored(scaling(-1, 1, 1), scaling(-3, 1, 1) * translation(0, 0, 8));
  EXPECT_LT(difference(mirrored.at(0.5f).m, scaling(-2, 1, 1) * translation(0, 0, 4)), 1e-14);
}

// Motion about a pivot is that of the matrices relative to the pivot. pbrt-v4 decomposes the
// matrices of instances in rendering space, whose origin is the camera.
TEST(Motion, ThePivotMovesStraight) {
  Numbers u{4};
  for (int i = 0; i < 100; ++i) {
    const Mat44d a = random_matrix(u, false), b = random_matrix(u, false);
    const Vec3d pivot(10 * u.centred(), 10 * u.centred(), 10 * u.centred());
    const MotionTransform t(a, b, pivot);
    const Mat44d to = translation(pivot.x, pivot.y, pivot.z), from = to.inverse();
    const MotionTransform seen(to * a * from, to * b * from);
    for (const float time : {0.2f, 0.7f}) {
      EXPECT_LT(difference(t.at(time).m, from * seen.at(time).m * to), 1e-11);
      const Vec3d straight = apply(a, pivot) * (1 - double(time)) + apply(b, pivot) * double(time);
      EXPECT_LT((apply(t.at(time).m, pivot) - straight).length(), 1e-11);
    }
  }
}

TEST(Motion, BoundsHoldEveryPointAndAreNotMuchLarger) {
  Numbers u{5};
  double share = 0;
  const int count = 300;
  for (int i = 0; i < count; ++i) {
    const bool mirror = i % 3 == 0;
    const Mat44d a = random_matrix(u, mirror);
    const Mat44d b = i % 2 ? random_matrix(u, mirror)
                           : a * rotation(170, Vec3d(u.centred(), u.centred(), u.centred()));
    const Vec3d pivot = i % 5 ? Vec3d(0, 0, 0) : Vec3d(5 * u(), 5 * u(), 5 * u());
    const MotionTransform t(a, b, pivot);
    Bounds3f box;
    for (int k = 0; k < 2; ++k)
      box.extendBy(Vec3f(float(u.centred()), float(u.centred()), float(u.centred())) * 3.0f);
    const float t0 = i % 4 ? 0.0f : float(u()), t1 = i % 4 ? 1.0f : std::min(1.0f, t0 + 0.3f);
    const Bounds3f bounds = t.bounds(box, t0, t1);
    const int segments = t.segments();
    EXPECT_GE(segments, 1);
    EXPECT_LE(segments, 16);
    Bounds3f tight;
    for (int k = 0; k <= 200; ++k) {
      const float time = lerp(static_cast<float>(k) / 200.0f, 0.0f, 1.0f);
      const Transform now = t.at(time);
      const float at = time * static_cast<float>(segments);
      const int step = std::min(static_cast<int>(at), segments - 1);
      const Bounds3f before = t.step_bounds(box, step, segments);
      const Bounds3f after = t.step_bounds(box, step + 1, segments);
      const float part = at - static_cast<float>(step);
      for (int c = 0; c < 8; ++c) {
        const Vec3f p =
            now.point(Vec3f(c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y,
                            c & 4 ? box.max.z : box.min.z));
        for (int j = 0; j < 3; ++j) {
          ASSERT_GE(p[j], lerp(part, before.min[j], after.min[j])) << i << " at " << time;
          ASSERT_LE(p[j], lerp(part, before.max[j], after.max[j])) << i << " at " << time;
        }
        if (time < t0 || time > t1) continue;
        tight.extendBy(p);
        ASSERT_TRUE(bounds.intersects(p)) << i << " at " << time;
      }
    }
    share += double(tight.size().length() / bounds.size().length()) / count;
  }
  EXPECT_GT(share, 0.95);
}

TEST(Motion, BoundsOfATranslationAreTight) {
  const MotionTransform t(Mat44d(), translation(4, 0, 0));
  const Bounds3f unit(Vec3f(0, 0, 0), Vec3f(1, 1, 1));
  const Bounds3f b = t.bounds(unit, 0.25f, 0.5f);
  EXPECT_NEAR(b.min.x, 1, 1e-5);
  EXPECT_NEAR(b.max.x, 3, 1e-5);
  EXPECT_EQ(t.segments(), 1);
  EXPECT_NEAR(t.step_bounds(unit, 0, 1).max.x, 1, 1e-5);
  EXPECT_NEAR(t.step_bounds(unit, 1, 1).min.x, 4, 1e-5);
  EXPECT_TRUE(t.bounds(Bounds3f(), 0, 1).isEmpty());
  EXPECT_TRUE(t.step_bounds(Bounds3f(), 0, 1).isEmpty());
}

}  // namespace
}  // namespace nephroid
