// Cameras look along local +z, with +x to the left and +y up. In pbrt-v4's camera space +x is to
// the right: the first axis changes its sign.
#include "input/mitsuba/sensor_plugins.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "input/mitsuba/film_plugins.h"
#include "input/mitsuba/medium_plugins.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/value_text.h"
#include "input/transform_directives.h"

namespace nephroid::mitsuba {
namespace {

/// Tangent of half of the angle of view along the film's width.
double half_width(PluginProperties& p, double aspect) {
  std::string axis = p.text("fov_axis", "x");
  double fov = p.number("fov", 0);
  if (!p.has("fov")) {
    std::string focal = p.text("focal_length", "50mm");
    if (focal.ends_with("mm")) focal.resize(focal.size() - 2);
    const double millimetres = finite_number(focal, "\"focal_length\"", p.where());
    if (!(millimetres > 0))
      throw SceneError(p.where(), "\"focal_length\" is not above 0, expected millimetres");
    // Film of 36 x 24 mm.
    fov = 2 * std::atan(std::hypot(36, 24) / (2 * millimetres)) / kDegree;
    axis = "diagonal";
  }
  if (!(fov > 0 && fov < 180))
    throw SceneError(p.where(), "\"fov\" must lie between 0 and 180 degrees");
  if (axis == "smaller") axis = aspect > 1 ? "y" : "x";
  if (axis == "larger") axis = aspect > 1 ? "x" : "y";
  const double tangent = std::tan(0.5 * fov * kDegree);
  if (axis == "x") return tangent;
  if (axis == "y") return tangent * aspect;
  if (axis == "diagonal") return tangent / std::sqrt(1 + 1 / (aspect * aspect));
  throw SceneError(p.where(),
                   "\"fov_axis\" is \"" + axis + "\", expected x, y, diagonal, smaller or larger");
}

/// The window of the screen, whose shorter side is from -1 to 1. Each point of the film shows what
/// lies the offset to the right and below, in units of the film.
void add_window(PluginProperties& p, ParameterSet& set, double aspect) {
  const double x = p.number("principal_point_offset_x", 0),
               y = p.number("principal_point_offset_y", 0);
  if (x == 0 && y == 0) return;
  const double width = std::max(1.0, aspect), height = std::max(1.0, 1 / aspect);
  add_numbers(set, "float", "screenwindow",
              {-width + 2 * width * x, width + 2 * width * x, -height - 2 * height * y,
               height - 2 * height * y});
}

void add_view(PluginProperties& p, CameraDescription& camera, double aspect) {
  camera.type = "perspective";
  const double across = half_width(p, aspect), shorter = across / std::max(1.0, aspect);
  add_float(camera.parameters, "fov", 2 * std::atan(shorter) / kDegree);
  add_window(p, camera.parameters, aspect);
}

void write_perspective(PluginProperties& p, CameraDescription& camera, double aspect) {
  add_view(p, camera, aspect);
  p.number("focus_distance", 0);  // of no use without a lens
}

void write_thin_lens(PluginProperties& p, CameraDescription& camera, double aspect) {
  add_view(p, camera, aspect);
  const double radius = p.number("aperture_radius", 0);
  if (!(radius >= 0))
    throw SceneError(p.where(), "\"aperture_radius\" is negative, expected 0 or more");
  const double distance = p.number("focus_distance", p.number("far_clip", 1e4));
  if (!(distance > 0))
    throw SceneError(p.where(), "\"focus_distance\" is not above 0, expected a distance");
  add_float(camera.parameters, "lensradius", radius);
  add_float(camera.parameters, "focaldistance", distance);
  if (!p.text("blades", "").empty()) warn_approximated(p, "the aperture is a disc");
}

/// The film is 2 units wide, times the scale of the transform.
void write_orthographic(PluginProperties& p, CameraDescription& camera, double aspect) {
  camera.type = "orthographic";
  add_numbers(camera.parameters, "float", "screenwindow", {-1, 1, -1 / aspect, 1 / aspect});
  p.number("focus_distance", 0);
}

struct SensorRow : Plugin {
  void (*write)(PluginProperties& properties, CameraDescription& camera, double aspect) = nullptr;
};
using enum PluginSupport;
constexpr const char* kNoPicture = "it measures light without a picture";
constexpr SensorRow kSensors[] = {
    {{"sensor", "perspective"}, write_perspective},
    {{"sensor", "thinlens"}, write_thin_lens},
    {{"sensor", "orthographic"}, write_orthographic},
    {{"sensor", "telecentric", kRefused, "this renderer has no such camera"}},
    {{"sensor", "spherical", kRefused, "this renderer has no such camera"}},
    {{"sensor", "perspective_rdist", kRefused, "lens distortion is not supported"}},
    {{"sensor", "irradiancemeter", kRefused, kNoPicture}},
    {{"sensor", "radiancemeter", kRefused, kNoPicture}},
    {{"sensor", "fluencemeter", kRefused, kNoPicture}},
    {{"sensor", "distant", kRefused, kNoPicture}},
    {{"sensor", "batch", kRefused, "this renderer has no such camera"}},
};

Mat44d world_to_camera(const Mat44d& camera_to_world) {
  return (scale_matrix({-1, 1, 1}) * camera_to_world).inverse();
}

/// Keyframes are at the ends of the shutter's interval; pbrt-v4 multiplies by its length, so that a
/// longer exposure is brighter, and Mitsuba does not.
void add_shutter(PluginProperties& p, CameraDescription& camera) {
  const double open = p.number("shutter_open", 0), close = p.number("shutter_close", open);
  if (!(close >= open))
    throw SceneError(p.where(), "\"shutter_close\" is earlier than \"shutter_open\"");
  if (close > open && (open != 0 || close != 1))
    warn_approximated(p,
                      "keyframe times are ignored: motion goes from the first keyframe to the last "
                      "while the shutter is open");
  add_float(camera.parameters, "shutteropen", 0);
  add_float(camera.parameters, "shutterclose", 1);
}

}  // namespace

void write_sensor(ImportContext& context, const Object& object, const std::string& scene_name) {
  PluginProperties p(object, context);
  const SensorRow& row = plugin_row(kSensors, object, context.diagnostics);
  CameraDescription camera = directive<CameraDescription>("", object.where);
  const FilmSize size = write_film(p, scene_name);
  write_sampler(p);
  row.write(p, camera, size.aspect());
  add_shutter(p, camera);
  const TransformDescription world = p.transform();
  camera.world_to_camera = {world_to_camera(world.start), world_to_camera(world.end)};
  if (const Object* medium = p.first_child("medium"))
    camera.medium = write_medium(context, *medium);
  p.report_unused();
  context.scene.camera = std::move(camera);
}

std::vector<Plugin> sensor_plugins() {
  std::vector<Plugin> all(std::begin(kSensors), std::end(kSensors));
  const std::vector<Plugin> films = film_plugins();
  all.insert(all.end(), films.begin(), films.end());
  return all;
}

}  // namespace nephroid::mitsuba
