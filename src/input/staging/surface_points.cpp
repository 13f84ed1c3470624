#include "input/staging/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {
namespace {

constexpr size_t kPoints = 4096;  ///< approximate number of all points
constexpr size_t kMaxPointsOfMesh = 256;
constexpr size_t kMaxPointsOfTriangle = 128;

/// A mesh at a place.
struct PlacedMesh {
  const ShapeDescription* shape;
  Mat44d to_world;
};

std::vector<PlacedMesh> meshes_of(const SceneDescription& scene) {
  std::vector<PlacedMesh> meshes;
  const auto add = [&](const ShapeDescription& shape, const Mat44d& to_world) {
    if (shape.type == "trianglemesh" && !shape.area_light)
      meshes.push_back({&shape, shape.transform.start * to_world});
  };
  for (const ShapeDescription& shape : scene.shapes) add(shape, Mat44d());
  for (const InstanceDescription& instance : scene.instances) {
    const auto object = scene.objects.find(instance.object);
    if (object == scene.objects.end()) continue;
    for (const ShapeDescription& shape : object->second.shapes)
      add(shape, instance.transform.start);
  }
  return meshes;
}

/// The fraction of bits in reverse (van der Corput).
double radical_inverse(size_t i) {
  double value = 0, digit = 0.5;
  for (; i > 0; i >>= 1, digit /= 2)
    if ((i & 1) != 0) value += digit;
  return value;
}

/// `count` points, evenly over a triangle, which stands for `weight` triangles like it.
void add_points(const std::array<Vec3d, 3>& corner, size_t count, double weight,
                std::vector<SurfacePoint>& points) {
  const Vec3d area = (corner[1] - corner[0]).cross(corner[2] - corner[0]) * 0.5;
  for (size_t i = 0; i < count; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double root = std::sqrt(u), v = radical_inverse(i) * root;
    points.push_back({corner[0] * (1 - root) + corner[1] * (root - v) + corner[2] * v,
                      area * (weight / static_cast<double>(count))});
  }
}

void add_points(const PlacedMesh& mesh, size_t count, std::vector<SurfacePoint>& points) {
  const Parameter* const points_of_mesh = mesh.shape->parameters.peek("P");
  const Parameter* const indices_of_mesh = mesh.shape->parameters.peek("indices");
  if (!points_of_mesh || !indices_of_mesh || indices_of_mesh->numbers.size() < 3) return;
  const std::vector<double>& p = points_of_mesh->numbers;
  const std::vector<double>& indices = indices_of_mesh->numbers;
  const size_t triangles = indices.size() / 3;
  const size_t step = (triangles + count - 1) / count;
  const size_t per_triangle = std::clamp(count / triangles, size_t{1}, kMaxPointsOfTriangle);
  for (size_t t = 0; t < triangles; t += step) {
    std::array<Vec3d, 3> corner;
    for (size_t k = 0; k < 3; ++k) {
      const double index = indices[3 * t + k];
      // An index out of range is an error of the mesh's maker.
      if (!(index >= 0 && index < static_cast<double>(p.size() / 3))) return;
      const double* v = &p[3 * static_cast<size_t>(index)];
      corner[k] = Vec3d(v[0], v[1], v[2]) * mesh.to_world;
    }
    add_points(corner, per_triangle, static_cast<double>(step), points);
  }
}

}  // namespace

std::vector<SurfacePoint> surface_points(const SceneDescription& scene) {
  const std::vector<PlacedMesh> meshes = meshes_of(scene);
  const size_t step = meshes.size() / kPoints + 1;
  const size_t each =
      std::clamp(kPoints / std::max(meshes.size(), size_t{1}), size_t{1}, kMaxPointsOfMesh);
  std::vector<SurfacePoint> points;
  for (size_t i = 0; i < meshes.size(); i += step) add_points(meshes[i], each, points);
  return points;
}

}  // namespace nephroid
