#include "input/staging/exposure.h"

#include <algorithm>
#include <cmath>

#include "input/staging/illumination.h"
#include "input/staging/surface_points.h"
#include "input/transform_directives.h"

namespace nephroid {
namespace {

constexpr double kShare = 0.75;  ///< share of the lit surfaces that get less

/// The field of view of a camera of glTF or of the default view. It knows nothing of shapes, so
/// hidden surfaces count as seen.
class View {
 public:
  /// The camera must have a transform with an inverse.
  View(const CameraDescription& camera, double aspect)
      : to_camera_(camera.world_to_camera.start),
        is_perspective_(camera.type == "perspective"),
        eye_(Vec3d(0, 0, 0) * to_camera_.inverse()) {
    to_camera_.inverse().multDirMatrix(Vec3d(0, 0, 1), forward_);
    const double side =
        is_perspective_ ? std::tan(camera.parameters.get_float("fov", 90) / 2 * kDegree) : 1;
    half_width_ = side * std::max(aspect, 1.0);
    half_height_ = side * std::max(1 / aspect, 1.0);
    const std::vector<float> window = camera.parameters.get_floats("screenwindow");
    if (window.size() != 4) return;
    half_width_ = std::max(std::abs(window[0]), std::abs(window[1]));
    half_height_ = std::max(std::abs(window[2]), std::abs(window[3]));
  }

  /// The size of a piece of surface in the picture, up to a factor: its solid angle, or its area
  /// as the orthographic camera sees it. 0 outside of the picture.
  double size(const SurfacePoint& point) const {
    const Vec3d c = point.p * to_camera_;
    const double scale = is_perspective_ ? c.z : 1;
    const bool is_seen =
        c.z > 0 && std::abs(c.x) <= half_width_ * scale && std::abs(c.y) <= half_height_ * scale;
    if (!is_seen) return 0;
    if (!is_perspective_) return std::abs(point.area_vector.dot(forward_));
    const Vec3d away = point.p - eye_;
    const double distance = away.length();
    return std::abs(point.area_vector.dot(away)) / (distance * distance * distance);
  }

 private:
  Mat44d to_camera_;
  bool is_perspective_;
  Vec3d eye_, forward_;
  double half_width_, half_height_;
};

double aspect_of(const SceneDescription& scene) {
  if (!scene.film) return 16.0 / 9.0;
  const ParameterSet& film = scene.film->parameters;
  const int width = film.get_int("xresolution", 1280), height = film.get_int("yresolution", 720);
  return width > 0 && height > 0 ? static_cast<double>(width) / height : 1;
}

/// Sizes of pieces of surface in the picture; their areas if none is in it.
std::vector<double> sizes_of(const std::vector<SurfacePoint>& points,
                             const SceneDescription& scene) {
  std::vector<double> sizes;
  double sum = 0;
  if (scene.camera && !is_singular(scene.camera->world_to_camera.start)) {
    const View view(*scene.camera, aspect_of(scene));
    for (const SurfacePoint& point : points) sum += sizes.emplace_back(view.size(point));
  }
  if (sum > 0) return sizes;
  sizes.clear();
  for (const SurfacePoint& point : points) sizes.push_back(point.area_vector.length());
  return sizes;
}

}  // namespace

double typical_illuminance(const SceneDescription& scene) {
  const std::vector<SurfacePoint> points = surface_points(scene);
  const std::vector<double> sizes = sizes_of(points, scene);
  const Illumination light(scene);
  std::vector<std::pair<double, double>> lit;  // illuminance and size
  double sum = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const double illuminance = light.at(points[i].p);
    if (!(illuminance > 0 && std::isfinite(illuminance) && sizes[i] > 0)) continue;
    lit.emplace_back(illuminance, sizes[i]);
    sum += sizes[i];
  }
  std::sort(lit.begin(), lit.end());
  double less = 0;
  for (const auto& [illuminance, size] : lit) {
    less += size;
    if (less >= kShare * sum) return illuminance;
  }
  return 0;
}

}  // namespace nephroid
