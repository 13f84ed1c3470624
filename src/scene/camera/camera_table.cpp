// The table of camera types, and loading code common to all; see camera_table.h.
#include "scene/camera/camera_table.h"

#include <vector>

#include "scene/shape/shape.h"

namespace nephroid {
namespace {

constexpr FormatParameter kShutter[] = {
    {"float", "shutteropen", "0", "s"},
    {"float", "shutterclose", "1", "s", "later than shutteropen; their distance is the exposure"},
};
constexpr FormatParameter kScreen[] = {
    {"float", "frameaspectratio", "that of the film"},
    {"float[4]", "screenwindow", "-1 to 1 along the shorter side"},
};
constexpr FormatParameter kThinLens[] = {
    {"float", "lensradius", "0", "scene units"},
    {"float", "focaldistance", "1e6", "scene units"},
};
constexpr FormatParameter kPerspective[] = {
    {"float", "fov", "90", "degrees", "of the shorter side, between 0 and 180"}};
constexpr FormatParameter kSpherical[] = {
    {"string", "mapping", "equalarea", "", "equalarea or equirectangular"},
    {"float", "lensradius", "0", "scene units", "there is no lens", Support::kNotNeeded},
    {"float", "focaldistance", "1e6", "scene units", "there is no lens", Support::kNotNeeded},
    {"float", "frameaspectratio", "that of the film", "", "there is no screen",
     Support::kNotNeeded},
    {"float[4]", "screenwindow", "", "", "there is no screen", Support::kNotNeeded},
};
constexpr FormatParameter kRealistic[] = {
    {"string", "lensfile", "none: an error", "", "a table of lenses, in mm"},
    {"float", "aperturediameter", "1", "mm",
     "of the stops; larger than the table's with a warning, then the table's"},
    {"float", "focusdistance", "10", "m", "too short for the lenses: an error"},
    {"string", "aperture", "circular", "",
     "circular, gaussian, square, pentagon, star or a square image file"},
};

constexpr CameraRow kTable[] = {
    {{"perspective", {kPerspective, kThinLens, kScreen, kShutter}}, make_perspective_camera},
    {{"orthographic", {kThinLens, kScreen, kShutter}}, make_orthographic_camera},
    {{"spherical", {kSpherical, kShutter}}, make_spherical_camera},
    {{"realistic",
      {kRealistic, kShutter},
      "rays that the lenses block are black, weights of the exit pupil as in pbrt-v4"},
     make_realistic_camera},
};

/// Each parameter can be valid alone while the camera is so far away, or its screen so large, that
/// floating-point numbers cannot represent its rays.
void check_rays(const Camera& camera, const CameraFilm& film, const SourceLocation& where) {
  const float w = static_cast<float>(film.width), h = static_cast<float>(film.height);
  for (const Vec2f& at :
       {Vec2f(0, 0), Vec2f(w, 0), Vec2f(0, h), Vec2f(w, h), Vec2f(w / 2, h / 2)}) {
    for (const float u_time : {0.0f, 0.5f, kOneMinusEpsilon}) {
      const std::optional<CameraRay> c = camera.generate_ray(at, Vec2f(0.3f, 0.6f), u_time);
      if (c && (!is_in_reach(c->ray.o) || !(std::abs(length(c->ray.d) - 1) < 1e-3f)))
        throw SceneError(where,
                         "the camera is too far away or its view too extreme, expected "
                         "coordinates up to 1e17");
    }
  }
}

}  // namespace

std::span<const CameraRow> camera_table() {
  return kTable;
}

std::vector<FormatType> camera_types() {
  return format_types(kTable);
}

CameraPlacement camera_placement(const SceneDescription& scene) {
  CameraPlacement placement;
  placement.keyframe_start = scene.transform_start_time;
  placement.keyframe_end = scene.transform_end_time;
  if (!scene.camera) return placement;
  const TransformDescription& world_to_camera = scene.camera->world_to_camera;
  if (!is_invertible(world_to_camera.start) || !is_invertible(world_to_camera.end))
    throw SceneError(scene.camera->where,
                     "the camera's transform cannot be inverted, expected one that can");
  placement.camera_to_world =
      MotionTransform(world_to_camera.start.inverse(), world_to_camera.end.inverse());
  const ParameterSet& p = scene.camera->parameters;
  placement.shutter_open = p.get_float("shutteropen", 0.0f);
  placement.shutter_close = p.get_float("shutterclose", 1.0f);
  return placement;
}

std::unique_ptr<Camera> make_camera(const SceneDescription& scene, const CameraFilm& film,
                                    Diagnostics& diagnostics) {
  static const ParameterSet kNone;
  const ParameterSet& p = scene.camera ? scene.camera->parameters : kNone;
  const std::string type = scene.camera ? scene.camera->type : "perspective";
  const CameraRow& row = row_of(kTable, "camera", type, p.where);
  std::unique_ptr<Camera> camera =
      row.make({p, camera_placement(scene), film, *scene.files, diagnostics});
  if (scene.camera) p.report_unused("camera \"" + type + "\"", row, diagnostics);
  check_rays(*camera, film, p.where);
  return camera;
}

}  // namespace nephroid
