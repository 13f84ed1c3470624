// Reads curve directives; see curve_directives.h. Parameters and defaults as in pbrt-v4.
#include "scene/curve_directives.h"

#include <algorithm>

#include "core/counted.h"
#include "scene/shape/curve.h"

namespace nephroid {

namespace {

/// Large enough to amortise a geometry's overhead, small enough to read a model in parallel.
constexpr size_t kMaxAlike = 4096;

bool same_type(const ShapeDescription& a, const ShapeDescription& b) {
  const Parameter* x = a.parameters.peek("type");
  const Parameter* y = b.parameters.peek("type");
  return x && y ? x->strings == y->strings : !x && !y;
}

bool alike(const ShapeDescription& a, const ShapeDescription& b) {
  return b.type == "curve" && !b.area_light && !b.parameters.peek("alpha") && same_type(a, b) &&
         a.material.index == b.material.index && a.material.name == b.material.name &&
         a.reverse_orientation == b.reverse_orientation && a.inside_medium == b.inside_medium &&
         a.outside_medium == b.outside_medium && a.transform.start == b.transform.start &&
         a.transform.end == b.transform.end;
}

CurveType type_of(const ParameterSet& p) {
  const std::string type = p.get_string("type", "flat");
  if (type == "flat") return CurveType::kFlat;
  if (type == "cylinder") return CurveType::kCylinder;
  if (type == "ribbon") return CurveType::kRibbon;
  throw SceneError(p.find("type")->where, "curve type \"" + type +
                                              "\" is unknown, expected \"flat\", \"cylinder\" or "
                                              "\"ribbon\"");
}

std::vector<CurveSegment> segments_of(const ParameterSet& p) {
  const int degree = p.get_int("degree", 3);
  if (degree != 2 && degree != 3)
    throw SceneError(p.find("degree")->where,
                     "a curve has degree " + std::to_string(degree) + ", expected 2 or 3");
  const std::string basis = p.get_string("basis", "bezier");
  if (basis != "bezier" && basis != "bspline")
    throw SceneError(p.find("basis")->where, "curve basis \"" + basis +
                                                 "\" is unknown, expected \"bezier\" or "
                                                 "\"bspline\"");
  const std::vector<Vec3f> points = p.get_point3s("P");
  for (const Vec3f& point : points)
    if (!is_in_reach(point))
      throw SceneError(p.find("P")->where,
                       "a point of this curve is not finite or too far away, expected coordinates "
                       "up to 1e17");
  const bool bezier = basis == "bezier";
  std::vector<CurveSegment> segments =
      bezier ? bezier_segments(points, degree) : bspline_segments(points, degree);
  if (segments.empty()) {
    const std::string first = std::to_string(degree + 1), next = std::to_string(degree);
    throw SceneError(p.where, "curve has " + counted(points.size(), "point") + " in \"P\", " +
                                  (bezier ? "expected " + first + " and " + next +
                                                " more for each further Bezier segment"
                                          : "expected at least " + first + " for its b-spline"));
  }
  return segments;
}

// Widths are linear over the whole curve, from one end of the directive's points to the other.
void set_widths(const ParameterSet& p, std::vector<CurveSegment>& segments) {
  const float width = p.get_float("width", 1.0f);
  const float ends[] = {p.get_float("width0", width), p.get_float("width1", width)};
  for (const float w : ends)
    if (!(w >= 0.0f && w <= kLargestCoordinate))
      throw SceneError(
          p.where,
          "a width of this curve is negative, not finite or beyond 1e17, expected 0 to 1e17");
  const float count = static_cast<float>(segments.size());
  for (size_t i = 0; i < segments.size(); ++i) {
    segments[i].width0 = lerp(static_cast<float>(i) / count, ends[0], ends[1]);
    segments[i].width1 = lerp(static_cast<float>(i + 1) / count, ends[0], ends[1]);
  }
}

void set_normals(const ParameterSet& p, CurveType type, std::vector<CurveSegment>& segments,
                 Diagnostics& diagnostics) {
  const std::vector<Vec3f> normals = p.get_normals("N");
  if (type != CurveType::kRibbon) {
    if (!normals.empty())
      diagnostics.warn(p.where, "\"N\" of a curve is ignored, only ribbons have normals");
    return;
  }
  if (normals.size() != segments.size() + 1)
    throw SceneError(p.where, "ribbon has " + counted(normals.size(), "normal") +
                                  " \"N\", expected " + std::to_string(segments.size() + 1) +
                                  ": one at each end of its segments");
  for (const Vec3f& n : normals)
    if (!is_finite(n) || !(max_component(abs(n)) > 0.0f))
      throw SceneError(p.find("N")->where,
                       "a normal of this ribbon is zero or not finite, expected a direction");
  for (size_t i = 0; i < segments.size(); ++i) {
    segments[i].normal0 = normalize(normals[i]);
    segments[i].normal1 = normalize(normals[i + 1]);
  }
}

}  // namespace

size_t curves_alike(std::span<const ShapeDescription> descriptions) {
  const ShapeDescription& first = descriptions[0];
  size_t count = 1;
  if (!alike(first, first)) return count;
  while (count < std::min(descriptions.size(), kMaxAlike) && alike(first, descriptions[count]))
    ++count;
  return count;
}

ShapePtr make_curves(std::span<const ShapeDescription> alike, const Transform& transform,
                     Diagnostics& diagnostics) {
  const ShapeDescription& first = alike[0];
  const CurveType type = type_of(first.parameters);
  std::vector<CurveSegment> all;
  for (const ShapeDescription& d : alike) {
    const ParameterSet& p = d.parameters;
    if (d.area_light)
      throw SceneError(d.area_light->where,
                       "a curve cannot be an area light, expected another shape");
    (void)p.find("type");
    std::vector<CurveSegment> segments = segments_of(p);
    set_widths(p, segments);
    set_normals(p, type, segments, diagnostics);
    if (segments.front().width0 > 0.0f || segments.back().width1 > 0.0f)
      all.insert(all.end(), segments.begin(), segments.end());
    else
      diagnostics.warn(d.where, "curve has no width and will be invisible");
  }
  auto shape = std::make_shared<CurveShape>(transform, first.reverse_orientation, type, all);
  for (uint32_t i = 0; i < shape->primitive_count(); ++i) {
    const Bounds3f box = shape->bounds(i);
    if (!is_in_reach(box.min) || !is_in_reach(box.max))
      throw SceneError(first.where,
                       "curve is too large or too far away, expected coordinates up to 1e17");
  }
  if (shape->primitive_count() > 0) return shape;
  if (!all.empty()) diagnostics.warn(first.where, "curve has no length and will be invisible");
  return nullptr;
}

}  // namespace nephroid
