// A camera's matrix as a LookAt and its rest in camera space: the mirrors and scales that stand
// before the LookAt in a scene file. It must not know scenes.
#pragma once

#include <optional>

#include "core/math.h"

namespace nephroid {

/// World to camera is the LookAt of eye, forward and up, and then the residual.
struct CameraFrame {
  Vec3d eye{0, 0, 0};
  Vec3d forward{0, 0, 1}, up{0, 1, 0};  ///< unit vectors, orthogonal
  Mat44d residual;                      ///< keeps the origin and the direction of +z

  Mat44d world_to_camera() const;
  /// World length of a unit of camera space along the axis, such as one of "focaldistance".
  double axis_scale() const;
};

/// The frame of an invertible affine matrix: the eye is the origin of camera space, forward the
/// direction of +z, up that of +y made orthogonal to it.
CameraFrame camera_frame(const Mat44d& world_to_camera);

/// The frame of a LookAt, without a residual; empty for points and vectors that are none
/// (look_at_matrix).
std::optional<CameraFrame> frame_looking_at(const Vec3d& eye, const Vec3d& target, const Vec3d& up);

/// The up vector that a person would write: the world axis nearest to the frame's up if it gives
/// the same frame, up to the rounding of single precision; else the frame's up.
Vec3d plain_up(const CameraFrame& frame);

/// True if eye, forward and up are the same up to the rounding of double precision at `distance`,
/// at which the frames' targets are.
bool is_same_view(const CameraFrame& a, const CameraFrame& b, double distance);

}  // namespace nephroid
