// Open cylinders around the object's z axis, whole or a sector. Parametrization: pbrt-v4, section
// 6.3.
#include "scene/shape/quadric.h"

namespace nephroid {
namespace {

class Cylinder final : public Quadric {
 public:
  Cylinder(const Transform& transform, bool reverse, double radius, double z_min, double z_max,
           double phi_max)
      : Quadric(transform, reverse),
        r_(radius),
        z_min_(std::min(z_min, z_max)),
        z_max_(std::max(z_min, z_max)),
        phi_max_(phi_max) {
    set_bounds(r_, z_min_, z_max_, 0.0);
  }

  void normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const override {
    *axis = Vec3f(0, 0, 1);
    *cos_half_angle = -1.0f;
  }

 private:
  Roots roots(const Vec3d& o, const Vec3d& d) const override {
    const double a = d.x * d.x + d.y * d.y;
    if (!(a > 0.0)) return {};
    const double nearest = -(o.x * d.x + o.y * d.y) / a;
    // Distance of the ray from the axis by the cross product, without cancellation far away.
    const double to_axis = std::abs(o.x * d.y - o.y * d.x) / std::sqrt(a);
    const double discriminant = (r_ - to_axis) * (r_ + to_axis);
    if (discriminant < 0.0) return {};
    const double half = std::sqrt(discriminant / a);
    return {2, {nearest - half, nearest + half}};
  }
  Vec3d project(const Vec3d& p) const override {
    const double rho = std::hypot(p.x, p.y);
    return rho > 0.0 ? Vec3d(p.x * (r_ / rho), p.y * (r_ / rho), p.z) : Vec3d(r_, 0, p.z);
  }
  bool contains(const Vec3d& p) const override {
    if (!(p.z >= z_min_ && p.z <= z_max_)) return false;
    return phi_max_ >= kTwoPiDouble || positive_angle(p.y, p.x) <= phi_max_;
  }
  Vec3d point_at(const Vec2d& uv) const override {
    const double phi = uv.x * phi_max_;
    return {r_ * std::cos(phi), r_ * std::sin(phi), z_min_ + uv.y * (z_max_ - z_min_)};
  }
  Vec2d uv_of(const Vec3d& p) const override {
    return {phi_max_ > 0.0 ? std::min(1.0, positive_angle(p.y, p.x) / phi_max_) : 0.0,
            z_max_ > z_min_ ? std::clamp((p.z - z_min_) / (z_max_ - z_min_), 0.0, 1.0) : 0.0};
  }
  Vec3d normal_of(const Vec3d& p) const override { return {p.x / r_, p.y / r_, 0}; }
  Derivatives derivatives_at(const Vec3d& p) const override {
    Derivatives by;
    by.dpdu = Vec3d(-p.y, p.x, 0.0) * phi_max_;
    by.dpdv = Vec3d(0.0, 0.0, z_max_ - z_min_);
    by.dndu = by.dpdu / r_;
    by.dndv = Vec3d(0, 0, 0);
    return by;
  }
  double local_area() const override { return phi_max_ * r_ * (z_max_ - z_min_); }
  Vec3d local_sample(const Vec2f& u) const override { return point_at(Vec2d(u.y, u.x)); }

  double r_, z_min_, z_max_, phi_max_;
};

}  // namespace

ShapePtr make_cylinder(const Transform& object_to_world, bool reverse_orientation, float radius,
                       float z_min, float z_max, float phi_max_degrees) {
  const double phi_max = std::clamp(double(phi_max_degrees), 0.0, 360.0) / 360.0 * kTwoPiDouble;
  return std::make_shared<Cylinder>(object_to_world, reverse_orientation, radius, z_min, z_max,
                                    phi_max);
}

}  // namespace nephroid
