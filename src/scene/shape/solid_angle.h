// Conversion of densities between area and solid angle, for all shapes. It must not know any
// particular shape.
#pragma once

#include <optional>

#include "scene/shape/shape.h"

namespace nephroid {

/// pdf_w at `from` of a point `p` with unit normal `ng` that was sampled with density pdf_a; 0 if
/// the surface is seen edge-on or `p` equals `from`.
inline float area_to_solid_angle(float pdf_a, const Vec3f& from, const Vec3f& p, const Vec3f& ng) {
  const Vec3d d(double(p.x) - from.x, double(p.y) - from.y, double(p.z) - from.z);
  const double projected = std::abs(d.x * ng.x + d.y * ng.y + d.z * ng.z);
  const double distance2 = d.dot(d);
  if (!(projected > 1e-12 * std::sqrt(distance2))) return 0.0f;
  const double pdf_w = pdf_a * distance2 * std::sqrt(distance2) / projected;
  return pdf_w < double(std::numeric_limits<float>::max()) ? static_cast<float>(pdf_w) : 0.0f;
}

/// Converts a sample with pdf_a to one with pdf_w at `from`. Empty if that density is 0.
inline std::optional<ShapeSample> seen_from(std::optional<ShapeSample> by_area, const Vec3f& from) {
  if (!by_area) return std::nullopt;
  by_area->pdf = area_to_solid_angle(by_area->pdf, from, by_area->p, by_area->ng);
  if (!(by_area->pdf > 0.0f)) return std::nullopt;
  return by_area;
}

}  // namespace nephroid
