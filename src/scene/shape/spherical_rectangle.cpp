// Solid angle and area-preserving parametrization of a rectangle seen from a point.
// Called by bilinear_mesh.cpp; the angles of the spherical rectangle are taken with atan2 instead
// of acos, which keeps their digits when the rectangle is seen at a grazing angle. Urena, Fajardo,
// King 2013.
#include "scene/shape/spherical_rectangle.h"

namespace nephroid {

SphericalRectangle::SphericalRectangle(const Vec3d& from, const Vec3d& corner, const Vec3d& edge_x,
                                       const Vec3d& edge_y) {
  const double length_x = edge_x.length(), length_y = edge_y.length();
  const Vec3d x = edge_x / length_x, y = edge_y / length_y;
  const Vec3d d = corner - from;
  x0_ = d.dot(x);
  x1_ = x0_ + length_x;
  y0_ = d.dot(y);
  y1_ = y0_ + length_y;
  z0_ = -std::abs(d.dot(x.cross(y)));
  if (z0_ == 0.0) return;

  // The four inner angles of the spherical rectangle; their excess is the solid angle.
  const auto angle = [this](double px, double py, double cosine) {
    return std::atan2(-z0_ * std::sqrt(px * px + py * py + z0_ * z0_), cosine);
  };
  const double g0 = angle(x1_, y0_, x1_ * y0_), g1 = angle(x1_, y1_, -x1_ * y1_);
  const double g2 = angle(x0_, y1_, x0_ * y1_), g3 = angle(x0_, y0_, -x0_ * y0_);
  const double two_pi = 2.0 * 3.14159265358979323846;
  k_ = two_pi - g2 - g3;
  solid_angle_ = std::max(0.0, g0 + g1 - k_);
}

Vec2f SphericalRectangle::sample(const Vec2f& u) const {
  const double b0 = -y0_ / std::hypot(y0_, z0_), b1 = y1_ / std::hypot(y1_, z0_);
  const double angle = u.x * solid_angle_ + k_;
  const double f = (std::cos(angle) * b0 - b1) / std::sin(angle);
  const double c = std::copysign(std::clamp(1.0 / std::hypot(f, b0), 0.0, 1.0), f);
  const double x = std::clamp(-c * z0_ / std::sqrt(1.0 - c * c), x0_, x1_);

  const double d2 = x * x + z0_ * z0_;
  const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
  const double h = h0 + u.y * (h1 - h0);
  const double y = std::clamp(h * std::sqrt(d2 / std::max(1e-300, 1.0 - h * h)), y0_, y1_);
  return {static_cast<float>((x - x0_) / (x1_ - x0_)), static_cast<float>((y - y0_) / (y1_ - y0_))};
}

}  // namespace nephroid
