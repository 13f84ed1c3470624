// Polar decomposition, spherical interpolation and bounds of moving transforms, see motion.h.
#include "core/motion.h"

namespace nephroid {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Rotation by which the path of a point leaves its chord by half a percent of the radius.
constexpr double kStraightAngle = kPiDouble / 16;

/// The orthogonal factor of the upper 3x3 of `linear`: the nearest rotation, possibly mirrored. The
/// Newton iteration R <- (R + R^-T) / 2 (Higham 1986) converges quadratically.
Mat44d orthogonal_factor(const Mat44d& linear) {
  // The scale does not change the factor, but the number of iterations.
  const double scale = std::cbrt(std::abs(linear.determinant()));
  Mat44d r = linear;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] /= scale;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Mat44d inverse = r.inverse();
    double change = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double next = 0.5 * (r[i][j] + inverse[j][i]);
        change = std::max(change, std::abs(next - r[i][j]));
        r[i][j] = next;
      }
    if (change < 1e-14) break;
  }
  return r;
}

/// The unit quaternion of a rotation matrix (row vectors). The largest component comes first, so
/// that none is divided by a small one (Shepperd 1978).
void quaternion_of(const Mat44d& r, double q[4]) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  int largest = 3;
  double best = trace;
  for (int i = 0; i < 3; ++i)
    if (r[i][i] > best) best = r[i][i], largest = i;
  if (largest == 3) {
    for (int i = 0; i < 3; ++i) q[i] = r[(i + 1) % 3][(i + 2) % 3] - r[(i + 2) % 3][(i + 1) % 3];
    q[3] = 1 + trace;
  } else {
    const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1 + 2 * r[i][i] - trace;
    q[j] = r[i][j] + r[j][i];
    q[k] = r[i][k] + r[k][i];
    q[3] = r[j][k] - r[k][j];
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; ++i) q[i] /= length;
}

/// The rotation matrix (row vectors) of a unit quaternion.
Mat44d rotation_of(const double q[4]) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Mat44d r;
  r[0][0] = 1 - 2 * (y * y + z * z);
  r[0][1] = 2 * (x * y + z * w);
  r[0][2] = 2 * (x * z - y * w);
  r[1][0] = 2 * (x * y - z * w);
  r[1][1] = 1 - 2 * (x * x + z * z);
  r[1][2] = 2 * (y * z + x * w);
  r[2][0] = 2 * (x * z + y * w);
  r[2][1] = 2 * (y * z - x * w);
  r[2][2] = 1 - 2 * (x * x + y * y);
  return r;
}

double dot4(const double a[4], const double b[4]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// True if the second quaternion must change its sign to interpolate the short way. A half turn has
/// two short ways. For "Rotate 180" about a coordinate axis, pbrt-v4's cosine is a rounding error
/// below zero, so it turns clockwise; this does the same.
bool is_long_way(const double from[4], const double to[4]) {
  const double cosine = dot4(from, to);
  constexpr double kHalfTurn = 1e-9;
  if (std::abs(cosine) > kHalfTurn) return cosine < 0;
  // Vector part of conjugate(from) * to: the axis in the space that is transformed.
  const Vec3d a(from[0], from[1], from[2]), b(to[0], to[1], to[2]);
  const Vec3d axis = b * from[3] - a * to[3] - a.cross(b);
  int largest = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(axis[i]) > std::abs(axis[largest])) largest = i;
  return axis[largest] > 0;
}

/// v times the upper 3x3 of m.
Vec3d times_linear(const Vec3d& v, const Mat44d& m) {
  Vec3d out;
  for (int j = 0; j < 3; ++j) out[j] = v.x * m[0][j] + v.y * m[1][j] + v.z * m[2][j];
  return out;
}

Vec3d corner_of(const Bounds3f& box, int corner) {
  return {corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
          corner & 4 ? box.max.z : box.min.z};
}

/// Rounds outwards to float, with room for the rounding of interpolated boxes.
Bounds3f rounded_outwards(const Vec3d& low, const Vec3d& high) {
  Bounds3f box;
  for (int i = 0; i < 3; ++i) {
    const double pad = gamma_bound(4) * std::max(std::abs(low[i]), std::abs(high[i]));
    box.min[i] = std::nextafter(static_cast<float>(low[i] - pad), -kInfinity);
    box.max[i] = std::nextafter(static_cast<float>(high[i] + pad), kInfinity);
  }
  return box;
}

}  // namespace

MotionTransform::Decomposition MotionTransform::decompose(const Mat44d& m, const Vec3d& pivot) {
  Decomposition d;
  for (int j = 0; j < 3; ++j) d.pivot_image[j] = times_linear(pivot, m)[j] + m[3][j];
  Mat44d linear = m;
  for (int i = 0; i < 3; ++i) linear[i][3] = linear[3][i] = 0;
  linear[3][3] = 1;
  Mat44d r = orthogonal_factor(linear);
  // The stretch takes the mirroring, which quaternions cannot represent.
  if (linear.determinant() < 0)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r[i][j] = -r[i][j];
  quaternion_of(r, d.rotation);
  d.stretch = linear * rotation_of(d.rotation).transposed();
  return d;
}

MotionTransform::MotionTransform(const Mat44d& start, const Mat44d& end, const Vec3d& pivot)
    : start_(start) {
  if (start == end) return;
  auto moving = std::make_shared<Moving>();
  moving->end = Transform(end);
  moving->pivot = pivot;
  moving->from = decompose(start, pivot);
  moving->to = decompose(end, pivot);
  const double* from = moving->from.rotation;
  double* to = moving->to.rotation;
  if (is_long_way(from, to))
    for (int i = 0; i < 4; ++i) to[i] = -to[i];
  double apart = 0;
  for (int i = 0; i < 4; ++i) apart += sqr(to[i] - from[i]);
  moving->half_angle = 2 * std::asin(std::min(1.0, 0.5 * std::sqrt(apart)));
  moving_ = std::move(moving);
}

Mat44d MotionTransform::matrix_at(double time) const {
  const Decomposition &a = moving_->from, &b = moving_->to;
  const double angle = moving_->half_angle;
  // Slerp: sin((1-t) angle) / sin(angle) and sin(t angle) / sin(angle), a lerp where they vanish.
  double wa = 1 - time, wb = time;
  if (angle > 1e-8) {
    wa = std::sin(wa * angle) / std::sin(angle);
    wb = std::sin(wb * angle) / std::sin(angle);
  }
  double q[4];
  for (int i = 0; i < 4; ++i) q[i] = wa * a.rotation[i] + wb * b.rotation[i];
  Mat44d stretch;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      stretch[i][j] = (1 - time) * a.stretch[i][j] + time * b.stretch[i][j];
  Mat44d m = stretch * rotation_of(q);
  const Vec3d turned_pivot = times_linear(moving_->pivot, m);
  for (int j = 0; j < 3; ++j)
    m[3][j] = (1 - time) * a.pivot_image[j] + time * b.pivot_image[j] - turned_pivot[j];
  return m;
}

Transform MotionTransform::at(float time) const {
  if (!moving_ || !(time > 0.0f)) return start_;
  if (time >= 1.0f) return moving_->end;
  return Transform(matrix_at(time));
}

/// Upper bound of the distance between a point's path and its chord within `duration`: duration^2 /
/// 8 times the largest acceleration. With v(t) = s(t) R(t), s linear and R turning by w in unit
/// time, |v''| <= w^2 |s| + 2 w |s'|.
double MotionTransform::bend(const Vec3d& from_pivot, double duration) const {
  const double w = 2 * moving_->half_angle;
  const Vec3d s0 = times_linear(from_pivot, moving_->from.stretch);
  const Vec3d s1 = times_linear(from_pivot, moving_->to.stretch);
  const double farthest = std::max(s0.length(), s1.length());
  return duration * duration / 8 * (w * w * farthest + 2 * w * (s1 - s0).length());
}

/// Extends low..high by `box` at `time`, grown by the bend of its corners within `duration`.
void MotionTransform::add_moment(const Bounds3f& box, double time, double duration, Vec3d& low,
                                 Vec3d& high) const {
  const Mat44d m = !moving_ || time <= 0 ? start_.m : time >= 1 ? moving_->end.m : matrix_at(time);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p = corner_of(box, corner);
    const double room = moving_ ? bend(p - moving_->pivot, duration) : 0.0;
    const Vec3d image = times_linear(p, m);
    for (int j = 0; j < 3; ++j) {
      low[j] = std::min(low[j], image[j] + m[3][j] - room);
      high[j] = std::max(high[j], image[j] + m[3][j] + room);
    }
  }
}

Bounds3f MotionTransform::bounds(const Bounds3f& box, float time0, float time1) const {
  if (box.isEmpty()) return {};
  Vec3d low(kFar), high(-kFar);
  const double t0 = std::clamp(double(time0), 0.0, 1.0), t1 = std::clamp(double(time1), t0, 1.0);
  const double angle = moving_ ? 2 * moving_->half_angle * (t1 - t0) : 0.0;
  const int pieces = std::max(1, static_cast<int>(std::ceil(angle / kStraightAngle)));
  for (int i = 0; i <= pieces; ++i)
    add_moment(box, t0 + (t1 - t0) * i / pieces, (t1 - t0) / pieces, low, high);
  return rounded_outwards(low, high);
}

int MotionTransform::segments() const {
  if (!moving_) return 1;
  return std::clamp(static_cast<int>(std::ceil(2 * moving_->half_angle / kStraightAngle)), 1, 16);
}

Bounds3f MotionTransform::step_bounds(const Bounds3f& box, int step, int segments) const {
  if (box.isEmpty()) return {};
  Vec3d low(kFar), high(-kFar);
  add_moment(box, double(step) / segments, 1.0 / segments, low, high);
  return rounded_outwards(low, high);
}

}  // namespace nephroid
