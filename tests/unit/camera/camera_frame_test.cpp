// A camera's matrix as eye, view, up and what is left in camera space.
#include "scene/camera/camera_frame.h"

#include <gtest/gtest.h>

#include <random>

#include "input/transform_directives.h"

namespace nephroid {
namespace {

double largest_entry(const Mat44d& m) {
  double largest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) largest = std::max(largest, std::abs(m[i][j]));
  return largest;
}

void expect_close(const Mat44d& a, const Mat44d& b, double relative) {
  EXPECT_LE(largest_entry(a - b), relative * largest_entry(b)) << a << b;
}

void expect_close(const Vec3d& a, const Vec3d& b, double error) {
  EXPECT_LE((a - b).length(), error) << a << " and " << b;
}

const Vec3d kEye(3, -4, 12), kTarget(-1, 0.5, 2), kUp(0, 0, 1);

Mat44d look() {
  return *look_at_matrix(kEye, kTarget, kUp);
}

TEST(CameraFrame, OfALookAtIsTheLookAt) {
  const CameraFrame frame = camera_frame(look());
  expect_close(frame.eye, kEye, 1e-13);
  expect_close(frame.forward, (kTarget - kEye).normalized(), 1e-14);
  EXPECT_NEAR(frame.up.dot(frame.forward), 0, 1e-14);
  EXPECT_NEAR(frame.up.cross(kUp).dot(frame.forward), 0, 1e-14);
  expect_close(frame.residual, Mat44d(), 1e-14);
  EXPECT_NEAR(frame.axis_scale(), 1, 1e-14);
}

TEST(CameraFrame, LeavesMirrorsAndScalesInTheResidual) {
  for (const Vec3d& factors : {Vec3d(-1, 1, 1), Vec3d(2, 2, 2), Vec3d(-0.5, 3, 4)}) {
    const CameraFrame frame = camera_frame(look() * scale_matrix(factors));
    expect_close(frame.eye, kEye, 1e-13);
    expect_close(frame.residual, scale_matrix(factors), 1e-14);
    EXPECT_NEAR(frame.axis_scale(), 1 / factors.z, 1e-14);
    expect_close(plain_up(frame), kUp, 0);
  }
}

TEST(CameraFrame, OfAnyMatrixGivesItAgain) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    Mat44d m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] = number(random) * (i == 3 ? 100 : 1);
    if (std::abs(m.determinant()) < 0.05) continue;
    const CameraFrame frame = camera_frame(m);
    expect_close(frame.world_to_camera(), m, 1e-12);
    // The axis of camera space is the view, and the origin the eye.
    EXPECT_NEAR(frame.residual[2][0], 0, 1e-12);
    EXPECT_NEAR(frame.residual[2][1], 0, 1e-12);
    EXPECT_GT(frame.residual[2][2], 0);
    Vec3d origin;
    m.multVecMatrix(frame.eye, origin);
    expect_close(origin, Vec3d(0, 0, 0), 1e-10);
  }
}

TEST(CameraFrame, KeepsDirectionsFarFromTheOrigin) {
  CameraFrame frame = camera_frame(look());
  frame.eye = Vec3d(1e9, -2e9, 3e9);
  const CameraFrame again = camera_frame(frame.world_to_camera());
  expect_close(again.forward, frame.forward, 1e-14);
  expect_close(again.up, frame.up, 1e-14);
}

TEST(CameraFrame, PlainUpIsAnAxisOnlyIfItGivesTheSameFrame) {
  const auto up_of = [](const Vec3d& up) { return plain_up(*frame_looking_at(kEye, kTarget, up)); };
  expect_close(up_of(Vec3d(0, 0, 7)), Vec3d(0, 0, 1), 0);
  expect_close(up_of(Vec3d(0, -2, 0)), Vec3d(0, -1, 0), 0);
  const Vec3d tilted = up_of(Vec3d(0.1, 0, 1));
  EXPECT_GT((tilted - Vec3d(0, 0, 1)).length(), 0.05);
  EXPECT_NEAR(tilted.dot((kTarget - kEye).normalized()), 0, 1e-14);
  // A level view along an axis leaves two axes; the nearer one is up.
  expect_close(plain_up(*frame_looking_at(Vec3d(0, 0, 0), Vec3d(0, 4, -1), Vec3d(0, 0, 1))),
               Vec3d(0, 0, 1), 0);
}

TEST(CameraFrame, IsEmptyForPointsThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(frame_looking_at(kEye, kEye, kUp));
  EXPECT_FALSE(frame_looking_at(kEye, kTarget, kTarget - kEye));
  EXPECT_FALSE(frame_looking_at(kEye, kTarget, Vec3d(0, 0, 0)));
  EXPECT_FALSE(frame_looking_at(kEye, kTarget, Vec3d(0, nan, 0)));
}

}  // namespace
}  // namespace nephroid
