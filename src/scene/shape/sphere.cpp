// Spheres, whole or clipped by z and phi, under any affine transform. From outside, whole spheres
// and ellipsoids are sampled by solid angle: by the cone in object space, with its density
// converted to world directions. Parametrization: pbrt-v4, section 6.2.
#include "scene/shape/quadric.h"
#include "scene/shape/solid_angle.h"

namespace nephroid {
namespace {

/// The tangent cone of a sphere of radius r from a point at distance D from its centre.
struct TangentCone {
  double distance, one_minus_cos_max;
  TangentCone(double r, double d) : distance(d) {
    const double sin2 = sqr(r / d);
    one_minus_cos_max = sin2 / (1.0 + std::sqrt(std::max(0.0, 1.0 - sin2)));
  }
  double pdf() const { return 1.0 / (kTwoPiDouble * one_minus_cos_max); }
};

class Sphere final : public Quadric {
 public:
  Sphere(const Transform& transform, bool reverse, double radius, double z_min, double z_max,
         double phi_max)
      : Quadric(transform, reverse), r_(std::abs(radius)), phi_max_(phi_max) {
    z_min_ = std::clamp(std::min(z_min, z_max), -r_, r_);
    z_max_ = std::clamp(std::max(z_min, z_max), -r_, r_);
    theta_at_min_ = std::acos(z_min_ / r_);
    theta_at_max_ = std::acos(z_max_ / r_);
    whole_ = z_min_ <= -r_ && z_max_ >= r_ && phi_max_ >= kTwoPiDouble;
    const double nearest_z = std::clamp(0.0, z_min_, z_max_);
    set_bounds(std::sqrt(std::max(0.0, r_ * r_ - nearest_z * nearest_z)), z_min_, z_max_, r_);
  }

  std::optional<ShapeSample> sample_towards(uint32_t, const Vec3f& from,
                                            const Vec2f& u) const override;
  float pdf_towards(uint32_t, const Vec3f& from, const Vec3f& p, const Vec3f& ng) const override;
  void normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const override {
    *axis = Vec3f(0, 0, 1);
    *cos_half_angle = -1.0f;
  }
  bool is_inside_out() const override { return whole_ && flip(); }

 private:
  Roots roots(const Vec3d& o, const Vec3d& d) const override;
  Vec3d project(const Vec3d& p) const override {
    const double l = std::sqrt(p.dot(p));
    return l > 0.0 ? p * (r_ / l) : Vec3d(0, 0, r_);
  }
  bool contains(const Vec3d& p) const override {
    if ((z_min_ > -r_ && p.z < z_min_) || (z_max_ < r_ && p.z > z_max_)) return false;
    return phi_max_ >= kTwoPiDouble || positive_angle(p.y, p.x) <= phi_max_;
  }
  Vec3d point_at(const Vec2d& uv) const override {
    const double phi = uv.x * phi_max_;
    const double theta = theta_at_min_ + uv.y * (theta_at_max_ - theta_at_min_);
    return Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                 std::cos(theta)) *
           r_;
  }
  Vec2d uv_of(const Vec3d& p) const override {
    const double theta = std::atan2(std::hypot(p.x, p.y), p.z);
    const double range = theta_at_max_ - theta_at_min_;
    return {phi_max_ > 0.0 ? std::min(1.0, positive_angle(p.y, p.x) / phi_max_) : 0.0,
            range != 0.0 ? std::clamp((theta - theta_at_min_) / range, 0.0, 1.0) : 0.0};
  }
  Vec3d normal_of(const Vec3d& p) const override { return p / r_; }
  Derivatives derivatives_at(const Vec3d& p) const override;
  double local_area() const override { return phi_max_ * r_ * (z_max_ - z_min_); }
  Vec3d local_sample(const Vec2f& u) const override {
    // By Archimedes, z is uniform.
    const double z = z_min_ + u.x * (z_max_ - z_min_), phi = u.y * phi_max_;
    const double rho = std::sqrt(std::max(0.0, r_ * r_ - z * z));
    return {rho * std::cos(phi), rho * std::sin(phi), z};
  }
  bool sees_cone(const Vec3d& o) const { return whole_ && o.dot(o) > r_ * r_; }
  /// Converts a density over object-space directions to one over world-space directions.
  float world_pdf_w(double pdf, const Vec3f& from, const Vec3f& p) const;

  double r_, z_min_, z_max_, phi_max_;
  double theta_at_min_, theta_at_max_;
  bool whole_;
};

Quadric::Roots Sphere::roots(const Vec3d& o, const Vec3d& d) const {
  const double a = d.dot(d);
  if (!(a > 0.0)) return {};
  const double nearest = -o.dot(d) / a;
  const Vec3d m = o + d * nearest;
  const double to_axis = std::sqrt(m.dot(m));
  const double discriminant = (r_ - to_axis) * (r_ + to_axis);
  if (discriminant < 0.0) return {};
  const double half = std::sqrt(discriminant / a);
  return {2, {nearest - half, nearest + half}};
}

Quadric::Derivatives Sphere::derivatives_at(const Vec3d& p) const {
  // At the poles phi is arbitrary; a minimal radius keeps dpdu a direction.
  const double rho = std::hypot(p.x, p.y);
  const double cos_phi = rho > 0.0 ? p.x / rho : 1.0, sin_phi = rho > 0.0 ? p.y / rho : 0.0;
  const double around = std::max(rho, 1e-5 * r_);
  Derivatives by;
  by.dpdu = Vec3d(-sin_phi, cos_phi, 0.0) * (phi_max_ * around);
  by.dpdv = Vec3d(p.z * cos_phi, p.z * sin_phi, -rho) * (theta_at_max_ - theta_at_min_);
  by.dndu = by.dpdu / r_;
  by.dndv = by.dpdv / r_;
  return by;
}

float Sphere::world_pdf_w(double pdf, const Vec3f& from, const Vec3f& p) const {
  if (is_similarity()) return static_cast<float>(pdf);
  // d(omega_object) / d(omega_world) = |det M^-1| / |M^-1 w|^3 for unit w.
  const Vec3d w(double(p.x) - from.x, double(p.y) - from.y, double(p.z) - from.z);
  const double stretch = std::sqrt(vector_to_object(w).dot(vector_to_object(w)) / w.dot(w));
  return static_cast<float>(pdf * inverse_determinant() / (stretch * stretch * stretch));
}

std::optional<ShapeSample> Sphere::sample_towards(uint32_t primitive, const Vec3f& from,
                                                  const Vec2f& u) const {
  const Vec3d o = to_object(from);
  if (!sees_cone(o)) return seen_from(sample_area(primitive, u), from);

  const TangentCone cone(r_, std::sqrt(o.dot(o)));
  const double one_minus_cos = u.x * cone.one_minus_cos_max;
  const double cos_theta = 1.0 - one_minus_cos;
  const double sin2_theta = one_minus_cos * (2.0 - one_minus_cos);
  // The nearer of the two points at that angle, by its position along and across the axis.
  const double half = std::sqrt(std::max(0.0, r_ * r_ - sqr(cone.distance) * sin2_theta));
  const double t = cone.distance * cos_theta - half;
  const double across = t * std::sqrt(sin2_theta), along = t * cos_theta - cone.distance;
  const double phi = kTwoPiDouble * u.y;

  const Vec3d axis = o * (-1.0 / cone.distance);
  const Frame frame = Frame::from_z(
      Vec3f(static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)));
  Vec3d x(frame.x.x, frame.x.y, frame.x.z);
  x = (x - axis * x.dot(axis)).normalized();
  const Vec3d y = axis.cross(x);
  const Vec3d p = project(axis * along + (x * std::cos(phi) + y * std::sin(phi)) * across);
  ShapeSample s = sample_of(p, 0.0f);
  s.pdf = world_pdf_w(cone.pdf(), from, s.p);
  if (!(s.pdf > 0.0f) || !std::isfinite(s.pdf)) return std::nullopt;
  return s;
}

float Sphere::pdf_towards(uint32_t primitive, const Vec3f& from, const Vec3f& p,
                          const Vec3f& ng) const {
  const Vec3d o = to_object(from);
  if (!sees_cone(o)) return Quadric::pdf_towards(primitive, from, p, ng);
  // Only the side that faces `from` is sampled; the margin covers rounding at the rim.
  const double distance = std::sqrt(o.dot(o));
  const double height = normal_to_object(ng).dot(o) * (flip() ? -1.0 : 1.0);
  if (height < r_ - 1e-4 * distance) return 0.0f;
  return world_pdf_w(TangentCone(r_, distance).pdf(), from, p);
}

}  // namespace

ShapePtr make_sphere(const Transform& object_to_world, bool reverse_orientation, float radius,
                     float z_min, float z_max, float phi_max_degrees) {
  const double phi_max = std::clamp(double(phi_max_degrees), 0.0, 360.0) / 360.0 * kTwoPiDouble;
  return std::make_shared<Sphere>(object_to_world, reverse_orientation, radius, z_min, z_max,
                                  phi_max);
}

}  // namespace nephroid
