#include <cmath>

#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/shape_geometry.h"
#include "input/transform_directives.h"

namespace nephroid::mitsuba {
namespace {

double positive_radius(PluginProperties& p) {
  const double radius = p.number("radius", 1);
  if (!(radius > 0)) throw SceneError(p.where(), "\"radius\" is not above 0, expected a length");
  return radius;
}

ShapeDescription placed(PluginProperties& p, const char* type, const Mat44d& local) {
  ShapeDescription shape = directive<ShapeDescription>(type, p.where());
  const TransformDescription world = p.transform();
  shape.transform = {local * world.start, local * world.end};
  return shape;
}

/// A rotation that takes +z to the unit vector.
Mat44d frame_of(const Vec3d& z) {
  Vec3f x, y;
  coordinate_system(to_float(z), &x, &y);
  const Vec3d side = z.cross(to_double(x)).normalized(), other = side.cross(z);
  Mat44d m;
  for (int i = 0; i < 3; ++i) {
    m[0][i] = other[i];
    m[1][i] = side[i];
    m[2][i] = z[i];
  }
  return m;
}

}  // namespace

Geometry sphere_geometry(PluginProperties& p) {
  const Vec3d center = p.point("center").value_or(Vec3d(0.0));
  ShapeDescription shape = placed(p, "sphere", translation_matrix(center));
  add_float(shape.parameters, "radius", positive_radius(p));
  return {{std::move(shape)}, false};
}

Geometry disk_geometry(PluginProperties& p) {
  return {{placed(p, "disk", Mat44d())}, true};
}

Geometry cylinder_geometry(PluginProperties& p) {
  const Vec3d from = p.point("p0").value_or(Vec3d(0.0)),
              to = p.point("p1").value_or(Vec3d(0, 0, 1));
  const double length = (to - from).length();
  if (!(length > 0) || !std::isfinite(length))
    throw SceneError(p.where(), "\"p0\" and \"p1\" of a cylinder are the same point, expected two");
  ShapeDescription shape =
      placed(p, "cylinder", frame_of((to - from) / length) * translation_matrix(from));
  add_float(shape.parameters, "radius", positive_radius(p));
  add_float(shape.parameters, "zmin", 0);
  add_float(shape.parameters, "zmax", length);
  return {{std::move(shape)}, true};
}

}  // namespace nephroid::mitsuba
