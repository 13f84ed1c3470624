#include "input/staging/scene_bounds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "input/mesh_data.h"

namespace nephroid {
namespace {

/// Takes the points of a shape, in its own space.
using PointVisit = std::function<void(const Vec3d&)>;

bool is_finite_point(const Vec3d& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void visit_corners(const Bounds3d& box, const PointVisit& visit) {
  if (box.isEmpty()) return;
  for (const double x : {box.min.x, box.max.x})
    for (const double y : {box.min.y, box.max.y})
      for (const double z : {box.min.z, box.max.z}) visit(Vec3d(x, y, z));
}

void visit_box(double radius, double z_min, double z_max, const PointVisit& visit) {
  visit_corners({Vec3d(-radius, -radius, z_min), Vec3d(radius, radius, z_max)}, visit);
}

/// Points "P".
void visit_points(const ParameterSet& p, SceneFiles&, const PointVisit& visit) {
  const Parameter* const points = p.peek("P");
  if (!points) return;
  const std::vector<double>& n = points->numbers;
  for (size_t i = 0; i + 2 < n.size(); i += 3) visit(Vec3d(n[i], n[i + 1], n[i + 2]));
}

void visit_ply(const ParameterSet& p, SceneFiles& files, const PointVisit& visit) {
  const std::string name = p.get_string("filename", "");
  if (name.empty()) return;  // an error of the shape's maker
  const MeshData mesh = read_ply(files, files.path_of(name), p.where);
  for (const Vec3f& point : mesh.positions) visit(to_double(point));
}

void visit_curve(const ParameterSet& p, SceneFiles& files, const PointVisit& visit) {
  const float width = p.get_float("width", 1);
  const double half = std::max(p.get_float("width0", width), p.get_float("width1", width)) / 2;
  const Vec3d margin(half, half, half);
  visit_points(p, files, [&](const Vec3d& point) {
    visit_corners({point - margin, point + margin}, visit);
  });
}

void visit_sphere(const ParameterSet& p, SceneFiles&, const PointVisit& visit) {
  const float r = p.get_float("radius", 1);
  const auto height = [&](const char* name, float fallback) {
    return std::clamp(p.get_float(name, fallback), -std::abs(r), std::abs(r));
  };
  const float a = height("zmin", -r), b = height("zmax", r);
  visit_box(std::abs(r), std::min(a, b), std::max(a, b), visit);
}

void visit_disk(const ParameterSet& p, SceneFiles&, const PointVisit& visit) {
  const double height = p.get_float("height", 0);
  visit_box(std::abs(p.get_float("radius", 1)), height, height, visit);
}

void visit_cylinder(const ParameterSet& p, SceneFiles&, const PointVisit& visit) {
  const float a = p.get_float("zmin", -1), b = p.get_float("zmax", 1);
  visit_box(std::abs(p.get_float("radius", 1)), std::min(a, b), std::max(a, b), visit);
}

struct ShapeVisit {
  const char* type;
  void (*visit)(const ParameterSet&, SceneFiles&, const PointVisit&);
};

constexpr ShapeVisit kVisits[] = {
    {"trianglemesh", visit_points}, {"plymesh", visit_ply},       {"bilinearmesh", visit_points},
    {"loopsubdiv", visit_points},   {"curve", visit_curve},       {"sphere", visit_sphere},
    {"disk", visit_disk},           {"cylinder", visit_cylinder},
};

/// Calls `visit` for the finite points of `p` at both ends of a motion.
void visit_moved(const Vec3d& p, const TransformDescription& transform, const PointVisit& visit) {
  const Vec3d start = p * transform.start;
  if (is_finite_point(start)) visit(start);
  if (!transform.is_animated()) return;
  const Vec3d end = p * transform.end;
  if (is_finite_point(end)) visit(end);
}

void visit_shapes(const std::vector<ShapeDescription>& shapes, SceneFiles& files,
                  const PointVisit& visit) {
  for (const ShapeDescription& shape : shapes) {
    const auto* const row =
        std::find_if(std::begin(kVisits), std::end(kVisits),
                     [&](const ShapeVisit& known) { return shape.type == known.type; });
    if (row == std::end(kVisits)) continue;  // an error of the table of shapes
    row->visit(shape.parameters, files,
               [&](const Vec3d& p) { visit_moved(p, shape.transform, visit); });
  }
}

Bounds3d bounds_of(const std::vector<ShapeDescription>& shapes, SceneFiles& files) {
  Bounds3d bounds;
  visit_shapes(shapes, files, [&](const Vec3d& p) { bounds.extendBy(p); });
  return bounds;
}

}  // namespace

SceneExtent scene_extent(const SceneDescription& scene, std::span<const Vec3d> directions) {
  SceneExtent extent;
  extent.furthest.assign(directions.size(), -std::numeric_limits<double>::infinity());
  const PointVisit add = [&](const Vec3d& p) {
    extent.bounds.extendBy(p);
    for (size_t i = 0; i < directions.size(); ++i)
      extent.furthest[i] = std::max(extent.furthest[i], p.dot(directions[i]));
  };
  visit_shapes(scene.shapes, *scene.files, add);
  std::map<std::string, Bounds3d> objects;
  for (const InstanceDescription& instance : scene.instances) {
    const auto object = scene.objects.find(instance.object);
    if (object == scene.objects.end()) continue;
    const auto [bounds, is_new] = objects.try_emplace(instance.object);
    if (is_new) bounds->second = bounds_of(object->second.shapes, *scene.files);
    visit_corners(bounds->second, [&](const Vec3d& p) { visit_moved(p, instance.transform, add); });
  }
  return extent;
}

}  // namespace nephroid
