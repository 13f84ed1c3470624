// Vectors, matrices, frames and transforms. Types are Imath's, so that libraries exchange them
// without copying. A point is a row vector, p' = p * M: the sixteen numbers of a pbrt "Transform"
// directive are the matrix in memory order, and "A then B" is A * B. It must not know
// intersections, light or files.
#pragma once

#include <ImathBox.h>
#include <ImathMatrix.h>
#include <ImathVec.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nephroid {

using Vec2f = Imath::V2f;
using Vec2i = Imath::V2i;
using Vec3f = Imath::V3f;
using Vec3d = Imath::V3d;
using Mat44d = Imath::M44d;
using Mat44f = Imath::M44f;
using Bounds3f = Imath::Box3f;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kPiDouble = 3.14159265358979323846;
inline constexpr double kTwoPiDouble = 2.0 * kPiDouble;
/// Radians in a degree, in double precision.
inline constexpr double kDegree = kPiDouble / 180;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kInv2Pi = 0.15915494309189533577f;
inline constexpr float kInv4Pi = 0.07957747154594766788f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;
/// Half an ulp of 1: the largest relative error of one rounded float operation.
inline constexpr float kMachineEpsilon = std::numeric_limits<float>::epsilon() * 0.5f;

/// Bound of the relative error of n chained float operations (Higham's gamma_n).
constexpr float gamma_bound(int n) {
  const float ne = static_cast<float>(n) * kMachineEpsilon;
  return ne / (1.0f - ne);
}

template <class T>
constexpr T sqr(T x) {
  return x * x;
}
inline float safe_sqrt(float x) {
  return std::sqrt(std::max(0.0f, x));
}
inline float lerp(float t, float a, float b) {
  return (1.0f - t) * a + t * b;
}

inline float dot(const Vec3f& a, const Vec3f& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline float abs_dot(const Vec3f& a, const Vec3f& b) {
  return std::abs(dot(a, b));
}
/// Cross product computed in double, so that nearly parallel vectors keep digits.
inline Vec3f cross(const Vec3f& a, const Vec3f& b) {
  const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
  return {static_cast<float>(ay * bz - az * by), static_cast<float>(az * bx - ax * bz),
          static_cast<float>(ax * by - ay * bx)};
}
inline float length_squared(const Vec3f& v) {
  return dot(v, v);
}
inline float length(const Vec3f& v) {
  return std::sqrt(length_squared(v));
}
/// v / |v|. Scales first when |v|^2 would leave the range of float; a null vector stays null.
inline Vec3f normalize(const Vec3f& v) {
  const float l2 = length_squared(v);
  if (l2 > 1e-30f && l2 < 1e30f) return v * (1.0f / std::sqrt(l2));
  const float m = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(m > 0.0f) || !std::isfinite(m)) return v;
  const Vec3f s(v.x / m, v.y / m, v.z / m);
  return s * (1.0f / std::sqrt(length_squared(s)));
}
inline Vec3d to_double(const Vec3f& v) {
  return {v.x, v.y, v.z};
}
/// Rounds each component once.
inline Vec3f to_float(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vec3f abs(const Vec3f& v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}
inline float max_component(const Vec3f& v) {
  return std::max({v.x, v.y, v.z});
}
inline bool is_finite(const Vec3f& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
/// n or -n, whichever lies in the hemisphere of v.
inline Vec3f face_forward(const Vec3f& n, const Vec3f& v) {
  return dot(n, v) < 0.0f ? -n : n;
}

/// Two unit vectors that make a right-handed frame with the unit vector z (Duff et al. 2017).
inline void coordinate_system(const Vec3f& z, Vec3f* x, Vec3f* y) {
  const float sign = std::copysign(1.0f, z.z);
  const float a = -1.0f / (sign + z.z);
  const float b = z.x * z.y * a;
  *x = Vec3f(1.0f + sign * sqr(z.x) * a, sign * b, -sign * z.x);
  *y = Vec3f(b, sign + sqr(z.y) * a, -z.y);
}

/// An orthonormal frame; local z is the normal.
struct Frame {
  Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  static Frame from_z(const Vec3f& unit_z) {
    Frame f;
    f.z = unit_z;
    coordinate_system(unit_z, &f.x, &f.y);
    return f;
  }
  /// z is kept, x is the part of `tangent` that is orthogonal to it (any x if there is none).
  static Frame from_z_and_tangent(const Vec3f& unit_z, const Vec3f& tangent) {
    const Vec3f t = tangent - unit_z * dot(unit_z, tangent);
    const float l2 = length_squared(t);
    if (!(l2 > 1e-14f * length_squared(tangent))) return from_z(unit_z);
    Frame f;
    f.z = unit_z;
    f.x = normalize(t);
    f.y = cross(unit_z, f.x);
    return f;
  }
  Vec3f to_local(const Vec3f& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3f to_world(const Vec3f& v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Trigonometry of unit vectors in a local frame, z up.
inline float cos_theta(const Vec3f& w) {
  return w.z;
}
inline float cos2_theta(const Vec3f& w) {
  return w.z * w.z;
}
inline float abs_cos_theta(const Vec3f& w) {
  return std::abs(w.z);
}
inline float sin2_theta(const Vec3f& w) {
  return std::max(0.0f, 1.0f - w.z * w.z);
}
inline bool same_hemisphere(const Vec3f& a, const Vec3f& b) {
  return a.z * b.z > 0.0f;
}

struct Ray {
  Vec3f o;
  Vec3f d;  ///< need not be unit length; t is in units of it
  float t_max = kInfinity;
  float time = 0.0f;  ///< 0..1, from the start to the end of motion (TransformTimes)
};

/// An affine (or, for cameras, projective) map with its inverse, row-vector convention.
struct Transform {
  Mat44d m;        ///< identity unless set
  Mat44d inverse;  ///< inverse of m

  Transform() = default;
  /// The caller has checked that `matrix` is invertible (see is_invertible).
  explicit Transform(const Mat44d& matrix) : m(matrix), inverse(matrix.inverse()) {}
  Transform(const Mat44d& matrix, const Mat44d& inv) : m(matrix), inverse(inv) {}

  Transform inverted() const { return {inverse, m}; }
  /// True if the map turns a right-handed frame into a left-handed one.
  bool swaps_handedness() const {
    const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return det < 0.0;
  }
  /// Maps a position, dividing by w if the matrix is projective.
  Vec3f point(const Vec3f& p) const {
    const double x = p.x, y = p.y, z = p.z;
    const double w = x * m[0][3] + y * m[1][3] + z * m[2][3] + m[3][3];
    const double s = w == 1.0 ? 1.0 : 1.0 / w;
    return {static_cast<float>((x * m[0][0] + y * m[1][0] + z * m[2][0] + m[3][0]) * s),
            static_cast<float>((x * m[0][1] + y * m[1][1] + z * m[2][1] + m[3][1]) * s),
            static_cast<float>((x * m[0][2] + y * m[1][2] + z * m[2][2] + m[3][2]) * s)};
  }
  /// Maps a direction or difference (no translation, no normalisation).
  Vec3f vector(const Vec3f& v) const {
    const double x = v.x, y = v.y, z = v.z;
    return {static_cast<float>(x * m[0][0] + y * m[1][0] + z * m[2][0]),
            static_cast<float>(x * m[0][1] + y * m[1][1] + z * m[2][1]),
            static_cast<float>(x * m[0][2] + y * m[1][2] + z * m[2][2])};
  }
  /// Maps a surface normal by the inverse transpose (not normalised).
  Vec3f normal(const Vec3f& n) const {
    const double x = n.x, y = n.y, z = n.z;
    const Mat44d& i = inverse;
    return {static_cast<float>(i[0][0] * x + i[0][1] * y + i[0][2] * z),
            static_cast<float>(i[1][0] * x + i[1][1] * y + i[1][2] * z),
            static_cast<float>(i[2][0] * x + i[2][1] * y + i[2][2] * z)};
  }
};

/// First `a`, then `b`.
inline Transform operator*(const Transform& a, const Transform& b) {
  return {a.m * b.m, b.inverse * a.inverse};
}

/// True if the matrix has finite entries and an inverse that double arithmetic can hold.
inline bool is_invertible(const Mat44d& m) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(m[i][j])) return false;
  const double det = m.determinant();
  return det != 0.0 && std::isfinite(det) && std::isfinite(1.0 / det);
}

/// Ray origin offset along the geometric normal `ng` to the side of `w` (pbrt-v4 section 6.8.6).
/// The offset just exceeds `p_error`, the absolute error bound of `p` per axis.
inline Vec3f offset_ray_origin(const Vec3f& p, const Vec3f& p_error, const Vec3f& ng,
                               const Vec3f& w) {
  const float d = dot(abs(ng), p_error);
  const Vec3f offset = dot(w, ng) < 0.0f ? ng * -d : ng * d;
  Vec3f po = p + offset;
  for (int i = 0; i < 3; ++i) {
    if (offset[i] > 0.0f)
      po[i] = std::nextafter(po[i], kInfinity);
    else if (offset[i] < 0.0f)
      po[i] = std::nextafter(po[i], -kInfinity);
  }
  return po;
}

}  // namespace nephroid
