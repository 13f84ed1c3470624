// An animated transform: two keyframes at times 0 and 1, interpolated as in pbrt by decomposition
// into translation, rotation and stretch (Shoemake & Duff 1992). It must not know shutters or scene
// files.
#pragma once

#include <memory>

#include "core/math.h"

namespace nephroid {

class MotionTransform {
 public:
  MotionTransform() = default;
  /// Both matrices are affine and invertible; equal ones do not move. Rotations turn about `pivot`,
  /// in the untransformed space, so its path is a straight line at constant speed.
  MotionTransform(const Mat44d& start, const Mat44d& end, const Vec3d& pivot = Vec3d(0, 0, 0));
  explicit MotionTransform(const Mat44d& fixed) : start_(fixed) {}

  bool moves() const { return moving_ != nullptr; }
  /// The transform at time in [0,1]; exactly the keyframes at and outside of 0 and 1. Costs a
  /// matrix inversion if it moves. If only one keyframe mirrors, the motion passes through a
  /// singular matrix without a usable inverse.
  Transform at(float time) const;
  /// A box around the path of `box` over [time0, time1], conservative: rotations are bounded by
  /// their arcs. Empty if `box` is.
  Bounds3f bounds(const Bounds3f& box, float time0, float time1) const;

  /// Number of equal pieces, 1 to 16, in which the motion is nearly straight, by the angle of the
  /// rotation.
  int segments() const;
  /// A box at time step/segments. The boxes of two neighbouring steps, interpolated linearly,
  /// contain `box` at all times in between.
  Bounds3f step_bounds(const Bounds3f& box, int step, int segments) const;

 private:
  /// One keyframe about the pivot: v -> v * stretch * rotation + pivot_image.
  struct Decomposition {
    Vec3d pivot_image{0, 0, 0};
    double rotation[4] = {0, 0, 0, 1};  ///< unit quaternion x y z w
    Mat44d stretch;                     ///< upper 3x3 only; negative definite if it mirrors
  };
  struct Moving {
    Transform end;
    Vec3d pivot{0, 0, 0};
    Decomposition from, to;
    double half_angle = 0;  ///< angle between the quaternions: half the rotation, 0..pi/2
  };
  static Decomposition decompose(const Mat44d& m, const Vec3d& pivot);
  Mat44d matrix_at(double time) const;
  double bend(const Vec3d& from_pivot, double duration) const;
  void add_moment(const Bounds3f& box, double time, double duration, Vec3d& low, Vec3d& high) const;

  Transform start_;
  std::shared_ptr<const Moving> moving_;  ///< null if nothing moves, so that instances stay small
};

}  // namespace nephroid
