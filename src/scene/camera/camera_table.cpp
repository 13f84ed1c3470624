// The table of camera types and what the loader does for all of them; see camera_table.h.
#include "scene/camera/camera_table.h"

#include <vector>

#include "input/spelling.h"
#include "scene/shape/shape.h"

namespace nephroid {
namespace {

constexpr CameraRow kTable[] = {
    {"perspective", make_perspective_camera},
    {"orthographic", make_orthographic_camera},
    {"spherical", make_spherical_camera},
    {"realistic", make_realistic_camera},
};

const CameraRow& row_of(const std::string& type, const SourceLocation& where) {
  std::vector<std::string> names;
  std::string expected;
  for (const CameraRow& row : kTable) {
    if (type == row.name) return row;
    names.emplace_back(row.name);
    expected += (expected.empty() ? "\"" : ", \"") + names.back() + "\"";
  }
  const std::string meant = did_you_mean(type, names);
  throw SceneError(where, "unknown camera \"" + type + "\"" +
                              (meant.empty() ? ", expected one of " + expected : meant));
}

CameraPlacement placement_of(const SceneDescription& scene) {
  CameraPlacement placement;
  placement.keyframe_start = scene.transform_start_time;
  placement.keyframe_end = scene.transform_end_time;
  if (!scene.camera) return placement;
  const TransformDescription& world_to_camera = scene.camera->world_to_camera;
  if (!is_invertible(world_to_camera.start) || !is_invertible(world_to_camera.end))
    throw SceneError(scene.camera->where, "the camera's transform cannot be inverted");
  placement.camera_to_world =
      MotionTransform(world_to_camera.start.inverse(), world_to_camera.end.inverse());
  const ParameterSet& p = scene.camera->parameters;
  placement.shutter_open = p.get_float("shutteropen", 0.0f);
  placement.shutter_close = p.get_float("shutterclose", 1.0f);
  return placement;
}

/// Each number may be fine alone and the camera still so far away, or its screen so large, that
/// floating-point numbers do not hold its rays.
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

std::unique_ptr<Camera> make_camera(const SceneDescription& scene, const CameraFilm& film,
                                    Diagnostics& diagnostics) {
  static const ParameterSet kNone;
  const ParameterSet& p = scene.camera ? scene.camera->parameters : kNone;
  const std::string type = scene.camera ? scene.camera->type : "perspective";
  const CameraRow& row = row_of(type, p.where);
  std::unique_ptr<Camera> camera =
      row.make({p, placement_of(scene), film, scene.directory, diagnostics});
  if (scene.camera) p.report_unused("camera \"" + type + "\"", diagnostics);
  check_rays(*camera, film, p.where);
  return camera;
}

}  // namespace nephroid
