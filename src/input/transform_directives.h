// The matrices of the directives Translate, Scale, Rotate, LookAt and Transform, in the row-vector
// convention of core/math.h: a directive's matrix T makes the current one T * ctm. It must not know
// the syntax of directives or what is transformed.
#pragma once

#include <array>
#include <optional>

#include "core/math.h"

namespace nephroid {

Mat44d translation_matrix(const Vec3d& offset);
Mat44d scale_matrix(const Vec3d& factors);
/// Rotation by `degrees`, counterclockwise seen from the tip of the axis; nothing if the axis is
/// null.
std::optional<Mat44d> rotation_matrix(double degrees, const Vec3d& axis);
/// World to camera: the camera is at `eye` and looks along +z at `target`; +y is up, +x is right (a
/// left-handed frame, as in pbrt). Empty if `eye` is `target` or `up` is parallel to the view.
std::optional<Mat44d> look_at_matrix(const Vec3d& eye, const Vec3d& target, const Vec3d& up);
/// The sixteen numbers in file order, which is memory order.
Mat44d matrix_from_numbers(const std::array<double, 16>& numbers);

/// True if the matrix has no inverse, up to rounding errors; independent of the units of its rows
/// and columns.
bool is_singular(const Mat44d& m);

/// True if the matrix leaves w unchanged, up to rounding errors: shapes cannot be projected.
bool is_affine(const Mat44d& m);

}  // namespace nephroid
