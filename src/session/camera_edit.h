// The camera as a person moves it: reading it from a scene's description and writing it there, and
// the point that a pixel sees. scene/scene_view.h takes the change into a built scene. It must not
// know renders.
#pragma once

#include <optional>

#include "input/scene_description.h"
#include "scene/scene.h"

namespace nephroid {

/// World space of the scene and its units. Optional values are absent where the camera's type does
/// not have them.
struct CameraPose {
  Vec3d eye{0, 0, 0}, target{0, 0, 1};  ///< two different points
  Vec3d up{0, 1, 0};                    ///< any length, not parallel to the view
  std::optional<double> fov;            ///< degrees, of the shorter side of the picture
  /// In units of camera space, which are the scene's unless the file scales its camera.
  std::optional<double> lens_radius, focal_distance;
  std::optional<double> shutter_open, shutter_close;
};

/// The pose of the description's camera when its shutter opens. The target lies on the axis, at the
/// focus of a lens if that is within the scene, else beside the middle of the scene. Up is a world
/// axis if one gives the same camera.
CameraPose camera_pose(const SceneDescription& description, const Scene& scene);

/// Moves the description's camera. What the pose does not say stays: type, medium, mirrors and
/// scales of the camera's own space, and all optional values that are empty. A camera that moves
/// while its shutter is open stands still afterwards, unless the view is the same as before. A
/// scene without a camera gets a perspective one. Throws UsageError for a pose that is none, and
/// for values that the type does not have; the description then stays as it was.
void set_camera(SceneDescription* description, const CameraPose& pose);

/// Sets the resolution of the description's film; adds a film if there is none.
void set_resolution(SceneDescription* description, int width, int height);

struct SeenPoint {
  Vec3f p;          ///< world space
  float depth = 0;  ///< along the camera's axis, in camera space, as "focaldistance" is
};

/// The surface point that the centre of a pixel sees, by the ray through the middle of the lens at
/// the middle of the shutter's time, behind interfaces and what alpha removes. Empty if there is
/// none.
std::optional<SeenPoint> seen_point(const Scene& scene, int x, int y);

}  // namespace nephroid
