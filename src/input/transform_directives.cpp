// Matrices of transform directives in double precision, and the test for singular ones.
#include "input/transform_directives.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

/// The unit vector along v, or nothing if v is null. Scales first to avoid under- and overflow.
std::optional<Vec3d> direction(const Vec3d& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return std::nullopt;
  const Vec3d scaled(v.x / largest, v.y / largest, v.z / largest);
  return scaled / std::sqrt(scaled.dot(scaled));
}

}  // namespace

Mat44d translation_matrix(const Vec3d& offset) {
  Mat44d m;
  for (int i = 0; i < 3; ++i) m[3][i] = offset[i];
  return m;
}

Mat44d scale_matrix(const Vec3d& factors) {
  Mat44d m;
  for (int i = 0; i < 3; ++i) m[i][i] = factors[i];
  return m;
}

std::optional<Mat44d> rotation_matrix(double degrees, const Vec3d& axis) {
  const std::optional<Vec3d> unit = direction(axis);
  if (!unit) return std::nullopt;
  const Vec3d& a = *unit;
  // Whole quarter turns are applied separately, so that they are exact.
  int quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &quarters) * kDegree;
  double s = std::sin(rest), c = std::cos(rest);
  for (int turn = 0; turn < (quarters & 3); ++turn) {
    const double cosine = c;
    c = -s;
    s = cosine;
  }
  // Rodrigues' formula: row i is the image of the i-th unit vector.
  Mat44d m;
  for (int i = 0; i < 3; ++i) {
    Vec3d e(0.0);
    e[i] = 1;
    const Vec3d turned = e * c + a.cross(e) * s + a * (a[i] * (1 - c));
    for (int j = 0; j < 3; ++j) m[i][j] = turned[j];
  }
  return m;
}

std::optional<Mat44d> look_at_matrix(const Vec3d& eye, const Vec3d& target, const Vec3d& up) {
  const std::optional<Vec3d> forward = direction(target - eye);
  const std::optional<Vec3d> unit_up = direction(up);
  if (!forward || !unit_up) return std::nullopt;
  const Vec3d sideways = unit_up->cross(*forward);
  // The sine of the angle between them; smaller values are rounding errors.
  constexpr double kParallel = 1e-12;
  if (!(sideways.dot(sideways) > kParallel * kParallel)) return std::nullopt;
  const Vec3d right = *direction(sideways);
  const Vec3d axes[3] = {right, forward->cross(right), *forward};
  Mat44d m;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) m[i][j] = axes[j][i];
    m[3][j] = -eye.dot(axes[j]);
  }
  return m;
}

Mat44d matrix_from_numbers(const std::array<double, 16>& numbers) {
  Mat44d m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m[i][j] = numbers[4 * i + j];
  return m;
}

bool is_affine(const Mat44d& m) {
  constexpr double kRounding = 1e-6;
  return std::abs(m[0][3]) <= kRounding && std::abs(m[1][3]) <= kRounding &&
         std::abs(m[2][3]) <= kRounding && std::abs(m[3][3] - 1) <= kRounding;
}

bool is_singular(const Mat44d& m) {
  // Rows and columns are divided by their largest entry, so the determinant has no units.
  Mat44d balanced = m;
  for (int i = 0; i < 4; ++i) {
    double largest = 0;
    for (int j = 0; j < 4; ++j) largest = std::max(largest, std::abs(balanced[i][j]));
    if (!(largest > 0)) return true;
    for (int j = 0; j < 4; ++j) balanced[i][j] /= largest;
  }
  for (int j = 0; j < 4; ++j) {
    double largest = 0;
    for (int i = 0; i < 4; ++i) largest = std::max(largest, std::abs(balanced[i][j]));
    if (!(largest > 0)) return true;
    for (int i = 0; i < 4; ++i) balanced[i][j] /= largest;
  }
  // The determinant is a sum of 24 products of entries of at most 1, each rounded a few times.
  constexpr double kRounding = 1e-14;
  return !(std::abs(balanced.determinant()) > kRounding);
}

}  // namespace nephroid
