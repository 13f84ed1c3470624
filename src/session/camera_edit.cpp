#include "session/camera_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/errors.h"
#include "input/parameter_list.h"
#include "scene/camera/camera.h"
#include "scene/camera/camera_frame.h"
#include "scene/camera/camera_table.h"
#include "scene/shape/shape.h"

namespace nephroid {
namespace {

/// A parameter of the Camera directive that a pose has.
struct PoseParameter {
  const char* name;
  std::optional<double> CameraPose::*value;
  double fallback;  ///< value of a camera that does not set it
};

constexpr PoseParameter kFieldOfView{"fov", &CameraPose::fov, 90},
    kLensRadius{"lensradius", &CameraPose::lens_radius, 0},
    kFocalDistance{"focaldistance", &CameraPose::focal_distance, 1e6},
    kShutterOpen{"shutteropen", &CameraPose::shutter_open, 0},
    kShutterClose{"shutterclose", &CameraPose::shutter_close, 1};
constexpr const PoseParameter* kParameters[] = {&kFieldOfView, &kLensRadius, &kFocalDistance,
                                                &kShutterOpen, &kShutterClose};

bool has_parameter(const std::string& camera_type, const char* name) {
  for (const FormatType& type : camera_types()) {
    if (camera_type != type.name) continue;
    const FormatParameter* parameter = type.find(name);
    return parameter != nullptr && parameter->support == Support::kRendered;
  }
  return false;
}

double pose_value(const ParameterSet& parameters, const PoseParameter& wanted) {
  const Parameter* parameter = parameters.peek(wanted.name);
  return parameter != nullptr && parameter->numbers.size() == 1 ? parameter->numbers[0]
                                                                : wanted.fallback;
}

/// The camera of the description, or the one that the renderer takes without a Camera directive.
CameraDescription camera_of(const SceneDescription& description) {
  if (description.camera) return *description.camera;
  CameraDescription camera;
  camera.type = "perspective";
  camera.where = {std::make_shared<const std::string>("camera of the view"), 0, 0};
  camera.parameters.where = camera.where;
  return camera;
}

/// World to camera when the shutter opens.
Mat44d first_matrix(const SceneDescription& description) {
  if (!description.camera) return Mat44d();
  const TransformDescription& matrices = description.camera->world_to_camera;
  if (!matrices.is_animated()) return matrices.start;
  const CameraPlacement placement = camera_placement(description);
  return placement.camera_to_world.at(placement.motion_time(0)).inverse;
}

/// World distance from the eye to the pose's target.
double target_distance(const CameraFrame& frame, const CameraPose& pose,
                       const SceneSphere& sphere) {
  constexpr double kMinDistance = 1e-3;  ///< radii of the scene
  const Vec3d to_centre = to_double(sphere.center) - frame.eye;
  if (pose.lens_radius.value_or(0) > 0 && pose.focal_distance) {
    const double focus = *pose.focal_distance * frame.axis_scale();
    if (focus <= to_centre.length() + sphere.radius) return focus;
  }
  const double along = to_centre.dot(frame.forward);
  return along > kMinDistance * sphere.radius ? along : sphere.radius;
}

[[noreturn]] void refuse(const std::string& fault) {
  throw UsageError("camera: " + fault);
}

void check_points(const CameraPose& pose) {
  for (const Vec3d& p : {pose.eye, pose.target})
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(p[i]) <= double{kLargestCoordinate}))
        refuse(
            "the eye or the target is too far away or not a number, expected coordinates up to "
            "1e17");
  if (pose.eye == pose.target)
    refuse("eye and target are the same point, expected two different points");
}

/// The frame of the pose, without a residual.
CameraFrame frame_of(const CameraPose& pose) {
  check_points(pose);
  const std::optional<CameraFrame> frame = frame_looking_at(pose.eye, pose.target, pose.up);
  if (!frame)
    refuse(
        "the up vector is zero, not a number, or parallel to the view, expected another direction");
  return *frame;
}

void check_values(const CameraPose& pose, const ParameterSet& parameters) {
  for (const PoseParameter* wanted : kParameters)
    if (const std::optional<double>& value = pose.*wanted->value)
      if (!(std::abs(*value) <= double{std::numeric_limits<float>::max()}))
        refuse(fmt::format("\"{}\" is not a finite float, expected a finite number", wanted->name));
  if (pose.fov && !(static_cast<float>(*pose.fov) > 0 && static_cast<float>(*pose.fov) < 180))
    refuse(fmt::format("the field of view is {:g} degrees, expected more than 0 and below 180",
                       *pose.fov));
  if (pose.lens_radius && *pose.lens_radius < 0)
    refuse(fmt::format("the lens radius is {:g}, expected 0 or more", *pose.lens_radius));
  if (pose.focal_distance && !(static_cast<float>(*pose.focal_distance) > 0))
    refuse(fmt::format("the focal distance is {:g}, expected more than 0", *pose.focal_distance));
  const auto open = static_cast<float>(pose_value(parameters, kShutterOpen)),
             close = static_cast<float>(pose_value(parameters, kShutterClose));
  if ((pose.shutter_open || pose.shutter_close) && !(close > open))
    refuse(fmt::format("the shutter opens at {:g} and closes at {:g}, expected it to close later",
                       open, close));
}

void set_values(CameraDescription* camera, const CameraPose& pose) {
  for (const PoseParameter* wanted : kParameters) {
    const std::optional<double>& value = pose.*wanted->value;
    if (!value) continue;
    if (!has_parameter(camera->type, wanted->name))
      refuse(fmt::format("a camera of type \"{}\" has no \"{}\", expected no value for it",
                         camera->type, wanted->name));
    if (pose_value(camera->parameters, *wanted) == *value) continue;
    ParameterList list(camera->parameters.where);
    list.add_float(wanted->name, *value);
    replace_parameter(&camera->parameters, list.take().list.front());
  }
}

/// The frame that the pose of `now` would give, whose up vector can be a world axis.
CameraFrame frame_of_own_pose(const CameraFrame& now) {
  CameraFrame frame = now;
  const Vec3d up = plain_up(now);
  frame.up = (up - now.forward * up.dot(now.forward)).normalized();
  return frame;
}

}  // namespace

CameraPose camera_pose(const SceneDescription& description, const Scene& scene) {
  const CameraFrame frame = camera_frame(first_matrix(description));
  const CameraDescription camera = camera_of(description);
  CameraPose pose;
  for (const PoseParameter* wanted : kParameters)
    if (has_parameter(camera.type, wanted->name))
      pose.*wanted->value = pose_value(camera.parameters, *wanted);
  pose.eye = frame.eye;
  pose.target = frame.eye + frame.forward * target_distance(frame, pose, scene.sphere);
  pose.up = plain_up(frame);
  return pose;
}

void set_camera(SceneDescription* description, const CameraPose& pose) {
  CameraDescription camera = camera_of(*description);
  CameraFrame frame = frame_of(pose);
  set_values(&camera, pose);
  check_values(pose, camera.parameters);
  const CameraFrame now = camera_frame(first_matrix(*description));
  if (!is_same_view(frame_of_own_pose(now), frame, (pose.target - pose.eye).length())) {
    frame.residual = now.residual;
    const Mat44d matrix = frame.world_to_camera();
    camera.world_to_camera = {matrix, matrix};
  }
  description->camera = std::move(camera);
}

void set_resolution(SceneDescription* description, int width, int height) {
  ParameterList size({std::make_shared<const std::string>("resolution of the view"), 0, 0});
  size.add_integer("xresolution", width);
  size.add_integer("yresolution", height);
  if (!description->film) description->film = ParameterList(size.where()).directive("rgb");
  for (Parameter& parameter : size.take().list)
    replace_parameter(&description->film->parameters, std::move(parameter));
}

std::optional<SeenPoint> seen_point(const Scene& scene, int x, int y) {
  constexpr Vec2f kMiddleOfLens(0.5f, 0.5f);
  constexpr float kMiddleOfShutter = 0.5f;
  const Vec2f film(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const std::optional<CameraRay> start =
      scene.camera->generate_ray(film, kMiddleOfLens, kMiddleOfShutter);
  if (!start) return std::nullopt;
  Ray ray = start->ray;
  for (int surfaces = 0; surfaces < kMaxStraightEvents; ++surfaces) {
    SurfaceInteraction hit;
    if (!scene.intersect(ray, hit)) return std::nullopt;
    if (!scene.materials[hit.material]->resolve(hit)->is_interface()) {
      const Transform to_world = scene.camera->camera_to_world(ray.time);
      return SeenPoint{hit.p, to_world.inverted().point(hit.p).z};
    }
    ray.o = hit.spawn_origin(ray.d);
  }
  return std::nullopt;
}

}  // namespace nephroid
