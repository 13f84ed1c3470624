#include "input/staging/default_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "input/parameter_list.h"
#include "input/transform_directives.h"

namespace nephroid {
namespace {

constexpr double kFieldOfView = 35;                           ///< degrees
constexpr double kCameraAzimuth = 35, kCameraElevation = 22;  ///< degrees, azimuth from the front
constexpr double kKeyAzimuth = -30, kKeyElevation = 50;
constexpr double kMargin = 0.1;  ///< part of the distance by which the camera stands back
const double kSlope = std::tan(kFieldOfView / 2 * kDegree);  ///< of the sides of the view

constexpr double kSkyShare = 0.35;   ///< share of the sky in the light on a surface facing the key
constexpr double kKeyDistance = 4;   ///< radii of the scene
constexpr double kKeyRadius = 1;     ///< radii of the scene
constexpr double kFloorRadius = 20;  ///< radii of the scene
constexpr double kFloorGap = 2e-4;   ///< radii of the scene
constexpr double kFloorReflectance = 0.5;

/// The unit vector at angles in degrees; azimuth counts from the front to the right.
Vec3d direction_from_front(const Surroundings& s, double azimuth, double elevation) {
  const double a = azimuth * kDegree, e = elevation * kDegree;
  return (s.east * std::sin(a) - s.north * std::cos(a)) * std::cos(e) + s.up * std::sin(e);
}

double radius_of(const Bounds3d& bounds) {
  const double radius = bounds.size().length() / 2;
  return radius > 0 ? radius : 1;
}

/// The largest component of the colour, or of the factor of the image, of an area light.
double largest_emission(const DirectiveDescription& light) {
  double largest = 1;
  for (const Parameter& p : light.parameters.list)
    if (p.type == "rgb" && !p.numbers.empty())
      largest = *std::max_element(p.numbers.begin(), p.numbers.end());
  return largest * light.parameters.get_float("scale", 1);
}

template <class Visit>
void for_each_corner(const Bounds3d& b, const Visit& visit) {
  for (const double x : {b.min.x, b.max.x})
    for (const double y : {b.min.y, b.max.y})
      for (const double z : {b.min.z, b.max.z}) visit(Vec3d(x, y, z));
}

/// A disk that faces its local +z, at `centre`, with z turned to the unit vector `normal`.
Mat44d disk_to_world(const Vec3d& centre, const Vec3d& normal) {
  const Vec3d away = std::abs(normal.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  Surroundings frame;
  frame.up = normal;
  frame.east = normal.cross(away).normalized();
  frame.north = frame.up.cross(frame.east);
  return frame.to_world() * translation_matrix(centre);
}

ShapeDescription& add_disk(SceneDescription* scene, double radius, const Mat44d& to_world,
                           double reflectance, const SourceLocation& where) {
  ParameterList matte(where);
  matte.add_color("reflectance", {reflectance, reflectance, reflectance});
  MaterialDescription material;
  static_cast<DirectiveDescription&>(material) = std::move(matte).directive("diffuse");
  ParameterList disk(where);
  disk.add_float("radius", radius);
  ShapeDescription& shape = scene->shapes.emplace_back();
  static_cast<DirectiveDescription&>(shape) = std::move(disk).directive("disk");
  shape.transform = {to_world, to_world};
  shape.material = {static_cast<int>(scene->materials.size()), "", where};
  scene->materials.push_back(std::move(material));
  return shape;
}

}  // namespace

SourceLocation not_in_a_file(const char* what) {
  return {std::make_shared<const std::string>(what), 0, 0};
}

FramedView::FramedView(const Surroundings& surroundings)
    : up_(surroundings.up),
      forward_(-direction_from_front(surroundings, kCameraAzimuth, kCameraElevation)) {
  right_ = forward_.cross(up_).normalized();
  above_ = right_.cross(forward_);
  sides_ = {right_ - forward_ * kSlope, -right_ - forward_ * kSlope, above_ - forward_ * kSlope,
            -above_ - forward_ * kSlope};
}

/// A point p is in view from `eye` if dot(p - eye, side) <= 0 for all sides. With the eye at
/// a right + b above + z forward, a pair of opposite sides gives a or b in the middle, and both
/// give upper bounds of z.
CameraDescription FramedView::camera(const SceneExtent& extent) const {
  const std::vector<double>& h = extent.furthest;
  const double a = (h[0] - h[1]) / 2, b = (h[2] - h[3]) / 2;
  const double near = std::min(-(h[0] + h[1]), -(h[2] + h[3])) / (2 * kSlope);
  const double centre = extent.bounds.center().dot(forward_);
  const double distance = std::max(centre - near, 0.1 * radius_of(extent.bounds));
  const double z = centre - distance * (1 + kMargin);
  const Vec3d eye = right_ * a + above_ * b + forward_ * z;
  ParameterList list(not_in_a_file("default camera"));
  list.add_float("fov", kFieldOfView);
  CameraDescription camera;
  static_cast<DirectiveDescription&>(camera) = std::move(list).directive("perspective");
  // Files of other programs have right-handed coordinates, and the camera's are left-handed.
  const Mat44d matrix =
      look_at_matrix(eye, eye + forward_, up_).value_or(Mat44d()) * scale_matrix(Vec3d(-1, 1, 1));
  camera.world_to_camera = {matrix, matrix};
  return camera;
}

bool has_light(const SceneDescription& scene, double glow) {
  return !scene.lights.empty() ||
         std::any_of(scene.shapes.begin(), scene.shapes.end(), [&](const ShapeDescription& shape) {
           return shape.area_light && (glow == 0 || largest_emission(*shape.area_light) > glow);
         });
}

void add_studio_light(SceneDescription* scene, const Bounds3d& bounds,
                      const Surroundings& surroundings) {
  ParameterList sky(not_in_a_file("default sky"));
  sky.add_color("L", {kSkyShare, kSkyShare, kSkyShare});
  sky.add_string("name", "sky");
  static_cast<DirectiveDescription&>(scene->lights.emplace_back()) =
      std::move(sky).directive("infinite");

  const double radius = radius_of(bounds);
  const Vec3d to_key = direction_from_front(surroundings, kKeyAzimuth, kKeyElevation);
  const SourceLocation where = not_in_a_file("default key light");
  ShapeDescription& key = add_disk(
      scene, radius * kKeyRadius,
      disk_to_world(bounds.center() + to_key * (radius * kKeyDistance), -to_key), 0, where);
  // Illuminance of a disk on its axis: pi L sin^2 of its angular radius.
  const double sine2 =
      kKeyRadius * kKeyRadius / (kKeyRadius * kKeyRadius + kKeyDistance * kKeyDistance);
  const double luminance = (1 - kSkyShare) / sine2;
  ParameterList emission(where);
  emission.add_color("L", {luminance, luminance, luminance});
  emission.add_string("name", "key");
  key.area_light = std::move(emission).directive("diffuse");
}

void add_floor(SceneDescription* scene, const Bounds3d& bounds, const Surroundings& surroundings) {
  double lowest = std::numeric_limits<double>::infinity();
  for_each_corner(bounds,
                  [&](const Vec3d& p) { lowest = std::min(lowest, p.dot(surroundings.up)); });
  const Vec3d centre = bounds.center();
  const double radius = radius_of(bounds);
  const Vec3d below =
      centre + surroundings.up * (lowest - radius * kFloorGap - centre.dot(surroundings.up));
  add_disk(scene, radius * kFloorRadius, disk_to_world(below, surroundings.up), kFloorReflectance,
           not_in_a_file("floor"));
}

}  // namespace nephroid
