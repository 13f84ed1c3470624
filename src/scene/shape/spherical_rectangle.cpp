// Solid angle and area-preserving parametrization of a rectangle seen from a point (Urena, Fajardo
// & King 2013). Inner angles use atan2 instead of acos, which keeps precision at grazing angles.
#include "scene/shape/spherical_rectangle.h"

namespace nephroid {

namespace {

// Argument of a complex number in [0, 2 pi).
double argument(double re, double im) {
  const double a = std::atan2(im, re);
  return a < 0.0 ? a + kTwoPiDouble : a;
}

}  // namespace

SphericalRectangle::SphericalRectangle(const Vec3d& from, const RectangleFrame& r) {
  const Vec3d d = r.corner - from;
  x0_ = d.dot(r.x);
  x1_ = x0_ + r.length_x;
  y0_ = d.dot(r.y);
  y1_ = y0_ + r.length_y;
  z0_ = -std::abs(d.dot(r.z));
  if (z0_ == 0.0) return;

  // The solid angle is the sum of the four inner angles minus 2 pi. Angles are added by multiplying
  // complex numbers, so one arc tangent is enough.
  const auto sine = [this](double px, double py) {
    return -z0_ * std::sqrt(px * px + py * py + z0_ * z0_);
  };
  const double c0 = x1_ * y0_, s0 = sine(x1_, y0_), c1 = -x1_ * y1_, s1 = sine(x1_, y1_);
  const double c2 = x0_ * y1_, s2 = sine(x0_, y1_), c3 = -x0_ * y0_, s3 = sine(x0_, y0_);
  const double re01 = c0 * c1 - s0 * s1, im01 = c0 * s1 + s0 * c1;
  start_re_ = c2 * c3 - s2 * s3;
  start_im_ = c2 * s3 + s2 * c3;
  solid_angle_ = argument(re01 * start_re_ - im01 * start_im_, re01 * start_im_ + im01 * start_re_);
  // Only points above the rectangle see more than half of a hemisphere. Elsewhere such a value is a
  // slightly negative angle that wrapped around.
  const bool above = x0_ < 0.0 && x1_ > 0.0 && y0_ < 0.0 && y1_ > 0.0;
  if (!above && solid_angle_ > 0.5 * kTwoPiDouble) solid_angle_ = 0.0;
}

Vec2f SphericalRectangle::sample(const Vec2f& u) const {
  const double z2 = z0_ * z0_;
  const double b0 = -y0_ / std::sqrt(y0_ * y0_ + z2);
  const double b1 = y1_ / std::sqrt(y1_ * y1_ + z2);
  // Cosine and sine of the angle minus the start's argument, each times the start's modulus.
  const double angle = u.x * solid_angle_;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const double modulus = std::sqrt(start_re_ * start_re_ + start_im_ * start_im_);
  const double f = ((cosine * start_re_ + sine * start_im_) * b0 - b1 * modulus) /
                   (sine * start_re_ - cosine * start_im_);
  // c / sqrt(1 - c^2), where c = 1 / sqrt(f^2 + b0^2) with the sign of f.
  const double reach = std::sqrt(std::max(1e-300, f * f + b0 * b0 - 1.0));
  const double x = std::clamp(std::copysign(-z0_ / reach, f), x0_, x1_);

  const double d2 = x * x + z2;
  const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
  const double h = h0 + u.y * (h1 - h0);
  const double y = std::clamp(h * std::sqrt(d2 / std::max(1e-300, 1.0 - h * h)), y0_, y1_);
  return {static_cast<float>((x - x0_) / (x1_ - x0_)), static_cast<float>((y - y0_) / (y1_ - y0_))};
}

}  // namespace nephroid
