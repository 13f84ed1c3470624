#include "session/camera_edit.h"
#include "session/inspect.h"
#include "session/light_layers.h"
#include "scene/camera/camera.h"
#include "scene/film_description.h"
namespace nephroid {
CameraPose camera_pose(const SceneDescription&, const Scene& s) { CameraPose p; p.eye = s.camera->camera_to_world(0).point({0,0,0}); p.target = s.sphere.center; p.up = s.camera->camera_to_world(0).vector({0,1,0}); p.fov = 45; return p; }
void check_pose(const CameraPose&) {}
void set_camera(SceneDescription*, const CameraPose&) {}
void renew_camera(Scene& s, const SceneDescription& d, const SceneOverrides& o, Diagnostics& g) { s.film = make_film_description(d, o, g); s.camera = make_camera(d, {s.film.width, s.film.height, s.film.diagonal_mm}, g); }
std::string camera_text(const SceneDescription&) { return "LookAt\n"; }
std::string scene_text_with_camera(const SceneDescription&, const std::string&) { return ""; }
std::optional<SeenPoint> seen_point(const Scene&, int, int) { return {}; }
std::vector<AovDefinition> light_layers(const Scene&) { return {}; }
}
