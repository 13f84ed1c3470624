// Shapes of strands as curves with a round cross-section.
#include <algorithm>

#include "core/counted.h"
#include "input/file_bytes.h"
#include "input/mitsuba/curve_file.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/shape_geometry.h"

namespace nephroid::mitsuba {
namespace {

std::vector<Strand> strands_of(PluginProperties& p, bool has_radii) {
  const std::string path = p.context().scene.files->path_of(p.file());
  const SourceLocation where = p.find("filename")->where;
  try {
    return read_strands(p.context().scene.files->read(path), has_radii, where);
  } catch (const IoError& error) {
    file_is_unreadable(where, error.what());
  }
}

std::vector<double> flat(const std::vector<Vec3f>& points) {
  std::vector<double> numbers;
  for (const Vec3f& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return numbers;
}

/// Control points of straight Bezier segments from point to point.
std::vector<Vec3f> straight_segments(const std::vector<Vec3f>& points) {
  std::vector<Vec3f> controls = {points[0]};
  for (size_t i = 1; i < points.size(); ++i) {
    const Vec3f step = points[i] - points[i - 1];
    controls.push_back(points[i - 1] + step * (1.0f / 3.0f));
    controls.push_back(points[i - 1] + step * (2.0f / 3.0f));
    controls.push_back(points[i]);
  }
  return controls;
}

ShapeDescription curve(PluginProperties& p, const std::vector<Vec3f>& points, const char* basis,
                       double width0, double width1) {
  ShapeDescription shape = directive<ShapeDescription>("curve", p.where());
  shape.transform = p.transform();
  add_text(shape.parameters, "type", "cylinder");
  add_text(shape.parameters, "basis", basis);
  add_numbers(shape.parameters, "point3", "P", flat(points));
  add_float(shape.parameters, "width0", width0);
  add_float(shape.parameters, "width1", width1);
  return shape;
}

/// Strands with a radius at each point; those with fewer points than `min_points` are an error.
Geometry with_radii(PluginProperties& p, size_t min_points, bool is_spline) {
  Geometry geometry;
  bool varies = false;
  for (const Strand& strand : strands_of(p, true)) {
    if (strand.points.size() < min_points)
      throw SceneError(p.find("filename")->where,
                       "a curve of the file has " + counted(strand.points.size(), "point") +
                           ", expected at least " + std::to_string(min_points));
    const double first = strand.radii.front(), last = strand.radii.back();
    for (size_t i = 0; i < strand.radii.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(strand.radii.size() - 1);
      const double linear = first + (last - first) * share;
      varies |= std::abs(strand.radii[i] - linear) > 0.01 * std::max(first, last);
    }
    geometry.shapes.push_back(curve(p, is_spline ? strand.points : straight_segments(strand.points),
                                    is_spline ? "bspline" : "bezier", 2 * first, 2 * last));
  }
  if (varies)
    warn_approximated(p, "radii are linear from the first point of a curve to the last one");
  return geometry;
}

}  // namespace

Geometry hair_geometry(PluginProperties& p) {
  // Mitsuba scales the radius by the transform, as it is done here with all curves.
  const double radius = p.number("radius", 0.025);
  p.number("angle_threshold", 1);  // of a simplification that the picture does not show
  if (p.number("reduction", 0) != 0) warn_approximated(p, "\"reduction\" is ignored");
  Geometry geometry;
  for (const Strand& strand : strands_of(p, false)) {
    if (strand.points.size() < 2) continue;
    geometry.shapes.push_back(
        curve(p, straight_segments(strand.points), "bezier", 2 * radius, 2 * radius));
  }
  return geometry;
}

Geometry spline_geometry(PluginProperties& p) {
  return with_radii(p, 4, true);
}

Geometry polyline_geometry(PluginProperties& p) {
  return with_radii(p, 2, false);
}

}  // namespace nephroid::mitsuba
