#include "input/staging/scene_bounds.h"

#include <algorithm>
#include <cmath>

#include "input/mesh_data.h"

namespace nephroid {
namespace {

void extend(Bounds3d* bounds, const Vec3d& p) {
  if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) bounds->extendBy(p);
}

Bounds3d box(double radius, double z_min, double z_max) {
  return {Vec3d(-radius, -radius, z_min), Vec3d(radius, radius, z_max)};
}

/// Bounds of the points "P", in object space.
Bounds3d of_points(const ParameterSet& p, SceneFiles&) {
  Bounds3d bounds;
  const auto points = std::find_if(p.list.begin(), p.list.end(), [](const Parameter& parameter) {
    return parameter.name == "P";
  });
  if (points == p.list.end()) return bounds;
  const std::vector<double>& n = points->numbers;
  for (size_t i = 0; i + 2 < n.size(); i += 3) extend(&bounds, Vec3d(n[i], n[i + 1], n[i + 2]));
  return bounds;
}

Bounds3d of_ply(const ParameterSet& p, SceneFiles& files) {
  Bounds3d bounds;
  const std::string name = p.get_string("filename", "");
  if (name.empty()) return bounds;  // an error of the shape's maker
  const MeshData mesh = read_ply(files, files.path_of(name), p.where);
  for (const Vec3f& point : mesh.positions) extend(&bounds, to_double(point));
  return bounds;
}

Bounds3d of_curve(const ParameterSet& p, SceneFiles& files) {
  Bounds3d bounds = of_points(p, files);
  const double width = p.get_float("width", 1);
  const double half = std::max(p.get_float("width0", static_cast<float>(width)),
                               p.get_float("width1", static_cast<float>(width))) /
                      2;
  if (bounds.isEmpty()) return bounds;
  const Vec3d margin(half, half, half);
  return {bounds.min - margin, bounds.max + margin};
}

Bounds3d of_sphere(const ParameterSet& p, SceneFiles&) {
  const float r = p.get_float("radius", 1);
  const auto height = [&](const char* name, float fallback) {
    return std::clamp(p.get_float(name, fallback), -std::abs(r), std::abs(r));
  };
  const float a = height("zmin", -r), b = height("zmax", r);
  return box(std::abs(r), std::min(a, b), std::max(a, b));
}

Bounds3d of_disk(const ParameterSet& p, SceneFiles&) {
  const double height = p.get_float("height", 0);
  return box(std::abs(p.get_float("radius", 1)), height, height);
}

Bounds3d of_cylinder(const ParameterSet& p, SceneFiles&) {
  const float a = p.get_float("zmin", -1), b = p.get_float("zmax", 1);
  return box(std::abs(p.get_float("radius", 1)), std::min(a, b), std::max(a, b));
}

struct BoundsOfType {
  const char* type;
  Bounds3d (*object_bounds)(const ParameterSet&, SceneFiles&);
};

constexpr BoundsOfType kTypes[] = {
    {"trianglemesh", of_points}, {"plymesh", of_ply},       {"bilinearmesh", of_points},
    {"loopsubdiv", of_points},   {"curve", of_curve},       {"sphere", of_sphere},
    {"disk", of_disk},           {"cylinder", of_cylinder},
};

Bounds3d moved(const Bounds3d& bounds, const TransformDescription& transform) {
  Bounds3d result;
  if (bounds.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p(corner & 1 ? bounds.max.x : bounds.min.x,
                  corner & 2 ? bounds.max.y : bounds.min.y,
                  corner & 4 ? bounds.max.z : bounds.min.z);
    extend(&result, p * transform.start);
    extend(&result, p * transform.end);
  }
  return result;
}

Bounds3d of_shapes(const std::vector<ShapeDescription>& shapes, SceneFiles& files) {
  Bounds3d all;
  for (const ShapeDescription& shape : shapes) {
    const auto* const row =
        std::find_if(std::begin(kTypes), std::end(kTypes),
                     [&](const BoundsOfType& known) { return shape.type == known.type; });
    if (row == std::end(kTypes)) continue;  // an error of the table of shapes
    all.extendBy(moved(row->object_bounds(shape.parameters, files), shape.transform));
  }
  return all;
}

}  // namespace

Bounds3d scene_bounds(const SceneDescription& scene) {
  Bounds3d all = of_shapes(scene.shapes, *scene.files);
  std::map<std::string, Bounds3d> objects;
  for (const InstanceDescription& instance : scene.instances) {
    const auto object = scene.objects.find(instance.object);
    if (object == scene.objects.end()) continue;
    const auto [bounds, is_new] = objects.try_emplace(instance.object);
    if (is_new) bounds->second = of_shapes(object->second.shapes, *scene.files);
    all.extendBy(moved(bounds->second, instance.transform));
  }
  return all;
}

}  // namespace nephroid
