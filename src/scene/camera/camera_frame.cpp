#include "scene/camera/camera_frame.h"

#include <algorithm>
#include <cmath>

#include "input/transform_directives.h"

namespace nephroid {
namespace {

Vec3d row(const Mat44d& m, int i) {
  return {m[i][0], m[i][1], m[i][2]};
}

/// The part of v that is orthogonal to the unit vector n.
Vec3d orthogonal_part(const Vec3d& v, const Vec3d& n) {
  return v - n * v.dot(n);
}

/// World to camera without the residual. The eye is not a part of the directions, so that they keep
/// their digits far away from the origin.
Mat44d look_matrix(const CameraFrame& frame) {
  const std::optional<Mat44d> turn = look_at_matrix(Vec3d(0, 0, 0), frame.forward, frame.up);
  return translation_matrix(-frame.eye) * turn.value_or(Mat44d());
}

}  // namespace

Mat44d CameraFrame::world_to_camera() const {
  return look_matrix(*this) * residual;
}

double CameraFrame::axis_scale() const {
  return row(residual.inverse(), 2).length();
}

CameraFrame camera_frame(const Mat44d& world_to_camera) {
  const Mat44d to_world = world_to_camera.inverse();
  CameraFrame frame;
  frame.eye = row(to_world, 3);
  frame.forward = row(to_world, 2).normalized();
  frame.up = orthogonal_part(row(to_world, 1), frame.forward).normalized();
  frame.residual = look_matrix(frame).inverse() * world_to_camera;
  for (int j = 0; j < 3; ++j) frame.residual[3][j] = 0;  // the eye is the origin but for rounding
  return frame;
}

std::optional<CameraFrame> frame_looking_at(const Vec3d& eye, const Vec3d& target,
                                            const Vec3d& up) {
  const std::optional<Mat44d> look = look_at_matrix(eye, target, up);
  if (!look) return std::nullopt;
  // The columns of the rotation are right, up and forward.
  CameraFrame frame;
  frame.eye = eye;
  for (int i = 0; i < 3; ++i) {
    frame.up[i] = (*look)[i][1];
    frame.forward[i] = (*look)[i][2];
  }
  return frame;
}

Vec3d plain_up(const CameraFrame& frame) {
  constexpr double kRounding = 1e-6, kMinSine = 1e-2;
  Vec3d best = frame.up;
  double best_cosine = 0;
  for (int i = 0; i < 3; ++i) {
    Vec3d axis(0, 0, 0);
    axis[i] = frame.up[i] < 0 ? -1 : 1;
    const Vec3d above = orthogonal_part(axis, frame.forward);
    const double cosine = std::abs(frame.up[i]);
    if (above.length() < kMinSine || cosine <= best_cosine ||
        (above.normalized() - frame.up).length() > kRounding)
      continue;
    best = axis;
    best_cosine = cosine;
  }
  return best;
}

bool is_same_view(const CameraFrame& a, const CameraFrame& b, double distance) {
  constexpr double kRounding = 1e-13;
  const double far = std::max(a.eye.length(), b.eye.length()) + distance;
  return (a.eye - b.eye).length() <= kRounding * far &&
         (a.forward - b.forward).length() <= kRounding * far / distance &&
         (a.up - b.up).length() <= kRounding * far / distance;
}

}  // namespace nephroid
