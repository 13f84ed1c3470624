#pragma once
#include <optional>
#include <string>
#include "scene/scene.h"
namespace nephroid {
struct CameraPose {
  Vec3f eye{0,0,0}, target{0,0,1}, up{0,1,0};
  std::optional<double> fov;
  std::optional<double> lens_radius, focal_distance;
  std::optional<double> shutter_open, shutter_close;
};
CameraPose camera_pose(const SceneDescription&, const Scene&);
void check_pose(const CameraPose&);
void set_camera(SceneDescription*, const CameraPose&);
void renew_camera(Scene&, const SceneDescription&, const SceneOverrides&, Diagnostics&);
std::string camera_text(const SceneDescription&);
std::string scene_text_with_camera(const SceneDescription&, const std::string& included);
struct SeenPoint { Vec3f p; float depth; }; std::optional<SeenPoint> seen_point(const Scene&, int x, int y);
}
