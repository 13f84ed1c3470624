// Solid angle and uniform directions of a triangle seen from a point. It must not know meshes.
// Paper: Arvo, Stratified Sampling of Spherical Triangles, SIGGRAPH 1995.
#include "scene/shape/spherical_triangle.h"

namespace nephroid {
namespace {

/// The unit vector along the component of v orthogonal to the unit vector axis.
Vec3d orthogonal_part(const Vec3d& v, const Vec3d& axis) {
  return (v - axis * v.dot(axis)).normalized();
}

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c)
    : a_(a / std::sqrt(a.dot(a))), b_(b / std::sqrt(b.dot(b))), c_(c / std::sqrt(c.dot(c))) {
  // The differences keep precision for small triangles.
  triple_ = std::abs(a_.dot((b_ - a_).cross(c_ - a_)));
  const double below = 1.0 + a_.dot(b_) + b_.dot(c_) + c_.dot(a_);
  solid_angle_ = 2.0 * std::atan2(triple_, below);
}

Vec3d SphericalTriangle::sample(const Vec2f& u) const {
  // The angle alpha at corner a is the angle between the planes (a,b) and (a,c).
  const Vec3d normal_ab = a_.cross(b_), normal_ac = a_.cross(c_);
  const double scale = std::hypot(normal_ab.dot(normal_ac), triple_);
  const double cos_alpha = normal_ab.dot(normal_ac) / scale;
  const double sin_alpha = triple_ / scale;

  // Corner c moves along the side a-c to c', so that (a,b,c') has the fraction u.x of the area.
  const double part = u.x * solid_angle_;
  const double sin_part = std::sin(part), cos_part = std::cos(part);
  const double s = sin_part * cos_alpha - cos_part * sin_alpha;  // sin(part - alpha)
  const double t = cos_part * cos_alpha + sin_part * sin_alpha;  // cos(part - alpha)
  const double p = t - cos_alpha;
  const double q = s + sin_alpha * a_.dot(b_);
  const double above = (q * t - p * s) * cos_alpha - q;
  const double below = (q * s + p * t) * sin_alpha;
  // At u.x = 0 both vanish, and c' is a.
  const double cos_b = below != 0.0 ? std::clamp(above / below, -1.0, 1.0) : 1.0;
  const Vec3d moved =
      a_ * cos_b + orthogonal_part(c_, a_) * std::sqrt(std::max(0.0, 1.0 - cos_b * cos_b));

  // Then a point on the arc from b to c', uniform in height above the plane orthogonal to b.
  const Vec3d chord = moved - b_;
  const double one_minus_z = u.y * 0.5 * chord.dot(chord);
  const double z = 1.0 - one_minus_z;
  const double r = std::sqrt(std::max(0.0, one_minus_z * (2.0 - one_minus_z)));
  return b_ * z + orthogonal_part(moved, b_) * r;
}

}  // namespace nephroid
