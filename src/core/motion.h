// A transform that moves: two keyframes, interpolated as pbrt does, the matrices decomposed into
// translation, rotation and stretch (Shoemake & Duff 1992). Time runs from 0 (start) to 1 (end).
// Who calls it: instances and cameras. It must not know shutters or scene files.
#pragma once

#include <optional>

#include "core/math.h"

namespace nephroid {

class MotionTransform {
 public:
  MotionTransform() = default;
  /// Both invertible; equal ones do not move.
  MotionTransform(const Mat44d& start, const Mat44d& end);
  explicit MotionTransform(const Mat44d& fixed) : MotionTransform(fixed, fixed) {}

  bool moves() const { return moves_; }
  /// The transform at time in [0,1]; exactly the keyframes at 0 and 1. Costs a matrix inversion
  /// when it moves.
  Transform at(float time) const;
  /// A box around the path of `box` over [time0, time1], conservative: rotations are bounded by
  /// their arcs.
  Bounds3f bounds(const Bounds3f& box, float time0, float time1) const;

 private:
  struct Decomposition {
    Vec3d translation{0, 0, 0};
    double rotation[4] = {0, 0, 0, 1};  ///< unit quaternion x y z w
    Mat44d stretch;                     ///< upper 3x3, may mirror
  };
  bool moves_ = false;
  Transform start_, end_;
  Decomposition from_, to_;
};

}  // namespace nephroid
