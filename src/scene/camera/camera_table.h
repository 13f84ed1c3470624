// The table of camera types: the scene format's name and the function that makes one. A new camera
// is one new file and one row. It must not know what the cameras do.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "input/format_rows.h"
#include "scene/camera/camera.h"

namespace nephroid {

/// Input of a factory.
struct CameraContext {
  const ParameterSet& parameters;  ///< parameters of the Camera directive
  CameraPlacement placement;
  CameraFilm film;
  SceneFiles& files;
  Diagnostics& diagnostics;
};

struct CameraRow : FormatType {
  std::unique_ptr<Camera> (*make)(const CameraContext&);
};

/// All camera types of the format.
std::span<const CameraRow> camera_table();
std::vector<FormatType> camera_types();

std::unique_ptr<Camera> make_perspective_camera(const CameraContext&);
std::unique_ptr<Camera> make_orthographic_camera(const CameraContext&);
std::unique_ptr<Camera> make_spherical_camera(const CameraContext&);
std::unique_ptr<Camera> make_realistic_camera(const CameraContext&);

}  // namespace nephroid
