#include "scene/shape/plane_rectangle.h"

#include "scene/shape/solid_angle.h"

namespace nephroid {

namespace {

/// Rectangles with a smaller solid angle are sampled by area (pbrt-v4).
constexpr double kMinRectangleArea = 1e-4;

}  // namespace

Vec3f error_of_patch(const BilinearPatch& patch) {
  double extent = 0.0;
  for (const Vec3d& e : {patch.p10 - patch.p00, patch.p01 - patch.p00, patch.p11 - patch.p00})
    extent = std::max({extent, std::abs(e.x), std::abs(e.y), std::abs(e.z)});
  Vec3d error;
  for (int i = 0; i < 3; ++i) {
    const double magnitude = std::abs(patch.p00[i]) + std::abs(patch.p10[i]) +
                             std::abs(patch.p01[i]) + std::abs(patch.p11[i]);
    error[i] = magnitude * 16.0 * 0x1p-53 + extent * gamma_bound(6);
  }
  return to_float(error * 0x1.00001p0);
}

void set_patch_point(const Vec3d& q, const Vec3f& patch_error, Vec3f* p, Vec3f* p_error) {
  *p = to_float(q);
  *p_error = abs(*p) * 0x1.0002p-24f + patch_error;
}

PlaneRectangle::PlaneRectangle(const BilinearPatch& patch, const Vec3f& normal)
    : frame_(patch.p00, patch.dpdu(0.0), patch.dpdv(0.0)),
      p00_(to_float(patch.p00)),
      p10_(to_float(patch.p10)),
      p01_(to_float(patch.p01)),
      p11_(to_float(patch.p11)),
      error_(error_of_patch(patch)),
      normal_(normal),
      area_(patch.cross(0.5, 0.5).length()) {}

std::optional<PlaneRectangle> Shape::rectangle(uint32_t) const {
  return std::nullopt;
}

ShapeSample PlaneRectangle::sample_at(const Vec2f& uv, double pdf) const {
  const BilinearPatch patch{to_double(p00_), to_double(p10_), to_double(p01_), to_double(p11_)};
  ShapeSample s;
  set_patch_point(patch.point(uv.x, uv.y), error_, &s.p, &s.p_error);
  s.ng = normal_;
  s.uv = uv;
  s.pdf = static_cast<float>(pdf);
  return s;
}

ShapeSample PlaneRectangle::sample_area(const Vec2f& u) const {
  return sample_at(u, 1.0 / area_);
}

std::optional<ShapeSample> PlaneRectangle::sample_towards(const Vec3f& from, const Vec2f& u) const {
  const SphericalRectangle seen(to_double(from), frame_);
  if (seen.solid_angle() > kMinRectangleArea)
    return sample_at(seen.sample(u), 1.0 / seen.solid_angle());
  return seen_from(sample_area(u), from);
}

float PlaneRectangle::pdf_towards(const Vec3f& from, const Vec3f& p, const Vec3f& ng) const {
  const SphericalRectangle seen(to_double(from), frame_);
  if (seen.solid_angle() > kMinRectangleArea) return static_cast<float>(1.0 / seen.solid_angle());
  return area_to_solid_angle(static_cast<float>(1.0 / area_), from, p, ng);
}

}  // namespace nephroid
