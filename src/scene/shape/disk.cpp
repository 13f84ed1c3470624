// Disks, rings and sectors, at a height above the object's xy plane. Area sampling stays uniform
// under affine maps, so areas are exact. Parametrization: pbrt-v4, section 6.4.
#include "core/warps.h"
#include "scene/shape/quadric.h"

namespace nephroid {
namespace {

class Disk final : public Quadric {
 public:
  Disk(const Transform& transform, bool reverse, double height, double radius, double inner,
       double phi_max)
      : Quadric(transform, reverse), height_(height), r_(radius), inner_(inner), phi_max_(phi_max) {
    set_bounds(r_, height_, height_, 0.0);
  }

  void normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const override {
    *axis = world_normal(Vec3d(0, 0, 1));
    *cos_half_angle = 1.0f;
  }

 private:
  Roots roots(const Vec3d& o, const Vec3d& d) const override {
    if (d.z == 0.0) return {};
    const double t = (height_ - o.z) / d.z;
    return {1, {t, t}};
  }
  Vec3d project(const Vec3d& p) const override { return {p.x, p.y, height_}; }
  bool contains(const Vec3d& p) const override {
    const double rho2 = p.x * p.x + p.y * p.y;
    if (!(rho2 <= r_ * r_) || rho2 < inner_ * inner_) return false;
    return phi_max_ >= kTwoPiDouble || positive_angle(p.y, p.x) <= phi_max_;
  }
  Vec3d point_at(const Vec2d& uv) const override {
    const double phi = uv.x * phi_max_, rho = r_ - uv.y * (r_ - inner_);
    return {rho * std::cos(phi), rho * std::sin(phi), height_};
  }
  Vec2d uv_of(const Vec3d& p) const override {
    const double rho = std::hypot(p.x, p.y);
    return {phi_max_ > 0.0 ? std::min(1.0, positive_angle(p.y, p.x) / phi_max_) : 0.0,
            r_ > inner_ ? std::clamp((r_ - rho) / (r_ - inner_), 0.0, 1.0) : 0.0};
  }
  Vec3d normal_of(const Vec3d&) const override { return {0, 0, 1}; }
  Derivatives derivatives_at(const Vec3d& p) const override {
    // At the centre phi is arbitrary; a minimal radius keeps dpdu a direction.
    const double rho = std::hypot(p.x, p.y);
    const double cos_phi = rho > 0.0 ? p.x / rho : 1.0, sin_phi = rho > 0.0 ? p.y / rho : 0.0;
    Derivatives by;
    by.dpdu = Vec3d(-sin_phi, cos_phi, 0.0) * (phi_max_ * std::max(rho, 1e-5 * r_));
    by.dpdv = Vec3d(cos_phi, sin_phi, 0.0) * (inner_ - r_);
    by.dndu = by.dndv = Vec3d(0, 0, 0);
    return by;
  }
  double local_area() const override {
    return std::max(0.0, 0.5 * phi_max_ * (r_ * r_ - inner_ * inner_));
  }
  Vec3d local_sample(const Vec2f& u) const override {
    if (inner_ == 0.0 && phi_max_ >= kTwoPiDouble) {
      const Vec2f d = square_to_disk(u);
      return {r_ * d.x, r_ * d.y, height_};
    }
    const double phi = u.y * phi_max_;
    const double rho = std::sqrt(inner_ * inner_ + u.x * (r_ * r_ - inner_ * inner_));
    return {rho * std::cos(phi), rho * std::sin(phi), height_};
  }

  double height_, r_, inner_, phi_max_;
};

}  // namespace

ShapePtr make_disk(const Transform& object_to_world, bool reverse_orientation, float height,
                   float radius, float inner_radius, float phi_max_degrees) {
  const double phi_max = std::clamp(double(phi_max_degrees), 0.0, 360.0) / 360.0 * kTwoPiDouble;
  return std::make_shared<Disk>(object_to_world, reverse_orientation, height, radius, inner_radius,
                                phi_max);
}

}  // namespace nephroid
