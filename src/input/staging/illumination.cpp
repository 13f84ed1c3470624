#include "input/staging/illumination.h"

#include <algorithm>
#include <cmath>

#include "core/color.h"

namespace nephroid {
namespace {

constexpr double kImageLuminance = 0.5;  ///< assumed mean of images of surroundings, cd/m^2
constexpr double kGlowShare = 0.25;      ///< assumed mean of images on shapes over their factor

/// Luminance of the colour `name` times "scale"; of white if there is no such colour.
double luminance_of(const ParameterSet& p, const char* name) {
  const double scale = p.get_float("scale", 1);
  for (const Parameter& parameter : p.list) {
    if (parameter.name != name || parameter.type != "rgb" || parameter.numbers.size() != 3)
      continue;
    const std::vector<double>& n = parameter.numbers;
    return scale * RgbColorSpace::srgb()
                       .to_xyz({static_cast<float>(n[0]), static_cast<float>(n[1]),
                                static_cast<float>(n[2])})
                       .y;
  }
  return scale;
}

Vec3d point_of(const ParameterSet& p, const char* name, const Vec3d& fallback) {
  const std::optional<Vec3f> point = p.get_point3(name);
  return point ? to_double(*point) : fallback;
}

/// 1 in the cone of a spot light, 0 outside, smooth in between.
double cone_share(const ParameterSet& p, double cosine) {
  const double outer = p.get_float("coneangle", 30);
  const double inner = outer - p.get_float("conedeltaangle", 5);
  const double from = std::cos(outer * kDegree), to = std::cos(inner * kDegree);
  if (cosine <= from) return 0;
  if (cosine >= to) return 1;
  const double t = (cosine - from) / (to - from);
  return t * t * (3 - 2 * t);
}

double illuminance_of_lamp(const LightDescription& light, const Vec3d& p) {
  const ParameterSet& parameters = light.parameters;
  const Vec3d from = point_of(parameters, "from", {0, 0, 0});
  const Vec3d place = from * light.transform.start;
  const Vec3d away = p - place;
  const double distance2 = away.dot(away);
  if (!(distance2 > 0)) return 0;
  double share = 1;
  if (light.type == "spot") {
    Vec3d axis;
    light.transform.start.multDirMatrix(point_of(parameters, "to", {0, 0, 1}) - from, axis);
    share = cone_share(parameters, axis.normalized().dot(away) / std::sqrt(distance2));
  }
  return share * luminance_of(parameters, "I") / distance2;
}

double illuminance_of_light(const LightDescription& light, const Vec3d& p) {
  const ParameterSet& parameters = light.parameters;
  const double wanted = parameters.get_float("illuminance", -1);
  if (wanted > 0) return wanted;
  if (light.type == "point" || light.type == "spot") return illuminance_of_lamp(light, p);
  if (light.type == "distant") return luminance_of(parameters, "L");
  if (light.type != "infinite") return 0;
  const bool has_image = parameters.find("filename") || parameters.find("faces");
  return kPiDouble * luminance_of(parameters, "L") *
         (has_image ? light.mean_luminance.value_or(kImageLuminance) : 1);
}

GlowingMesh glow_of(const ShapeDescription& shape) {
  GlowingMesh glow;
  const Parameter* const p_of_mesh = shape.parameters.peek("P");
  const Parameter* const indices_of_mesh = shape.parameters.peek("indices");
  if (shape.type != "trianglemesh" || !p_of_mesh || !indices_of_mesh) return glow;
  const std::vector<double>& points = p_of_mesh->numbers;
  const std::vector<double>& indices = indices_of_mesh->numbers;
  const auto corner = [&](size_t i) {
    const auto vertex = static_cast<size_t>(indices[i]) * 3;
    if (vertex + 2 >= points.size()) return Vec3d(0, 0, 0);  // an error of the mesh's maker
    return Vec3d(points[vertex], points[vertex + 1], points[vertex + 2]) * shape.transform.start;
  };
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Vec3d a = corner(i), b = corner(i + 1), c = corner(i + 2);
    const Vec3d normal = (b - a).cross(c - a) * 0.5;
    glow.area += normal.length();
    glow.area_vector += normal;
    glow.centre += (a + b + c) * (normal.length() / 3);
  }
  if (glow.area > 0) glow.centre /= glow.area;
  const bool is_mirrored = shape.transform.start.determinant() < 0;
  if (shape.reverse_orientation != is_mirrored) glow.area_vector = -glow.area_vector;
  const ParameterSet& p = shape.area_light->parameters;
  const bool has_image = p.peek("filename") != nullptr;
  glow.luminance = luminance_of(p, has_image ? "factor" : "L") * (has_image ? kGlowShare : 1);
  glow.is_two_sided = p.get_bool("twosided", false);
  return glow;
}

}  // namespace

/// The luminance times the solid angle, which is that of a disk of the area that is seen. A closed
/// convex mesh shows a quarter of its area.
double GlowingMesh::illuminance(const Vec3d& p) const {
  const Vec3d away = p - centre;
  const double distance2 = away.dot(away);
  if (!(distance2 > 0)) return 0;
  const double facing = area_vector.dot(away) / std::sqrt(distance2);
  const double seen =
      (is_two_sided ? std::abs(facing) : std::max(facing, 0.0)) + (area - area_vector.length()) / 4;
  return luminance * seen / (distance2 + seen / kPiDouble);
}

Illumination::Illumination(const SceneDescription& scene) : lights_(scene.lights) {
  for (const ShapeDescription& shape : scene.shapes)
    if (shape.area_light) glows_.push_back(glow_of(shape));
}

double Illumination::at(const Vec3d& p) const {
  double sum = 0;
  for (const LightDescription& light : lights_) sum += illuminance_of_light(light, p);
  for (const GlowingMesh& glow : glows_) sum += glow.illuminance(p);
  return sum;
}

}  // namespace nephroid
