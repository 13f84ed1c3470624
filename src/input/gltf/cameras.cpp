#include "input/gltf/cameras.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "input/parameter_list.h"

namespace nephroid::gltf {
namespace {

/// A node with a camera.
struct PlacedCamera {
  size_t node;
  JsonValue camera;
  std::string name;  ///< of the node, else of the camera
};

std::vector<PlacedCamera> shown_cameras(Document& document, const NodeGraph& nodes) {
  std::vector<PlacedCamera> cameras;
  // In the order of the file, which users count.
  std::vector<size_t> shown = nodes.shown();
  std::sort(shown.begin(), shown.end());
  for (const size_t index : shown) {
    const JsonValue& node = document.list("nodes")[index];
    if (!node.find("camera")) continue;
    const JsonValue& camera = document.item_of("cameras", node, "camera");
    cameras.push_back({index, camera, node.get_text("name", camera.get_text("name", ""))});
  }
  return cameras;
}

const PlacedCamera& chosen_camera(Document& document, const std::vector<PlacedCamera>& cameras) {
  const std::string& wanted = document.options().camera;
  if (wanted.empty()) return cameras.front();
  std::string names;
  for (const PlacedCamera& camera : cameras) {
    if (camera.name == wanted || camera.camera.get_text("name", "") == wanted) return camera;
    names += (names.empty() ? "\"" : ", \"") + camera.name + "\"";
  }
  size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (error == std::errc() && end == wanted.data() + wanted.size() && index < cameras.size())
    return cameras[index];
  document.root().fail("there is no camera \"" + wanted + "\", expected one of " + names +
                       " or an index below " + std::to_string(cameras.size()));
}

/// The longer side of the film in pixels.
constexpr double kFilmSide = 1280;

void add_film(SceneDescription& scene, double aspect, const SourceLocation& where) {
  const double width = aspect >= 1 ? kFilmSide : kFilmSide * aspect;
  const double height = aspect >= 1 ? kFilmSide / aspect : kFilmSide;
  ParameterList list(where);
  list.add_numbers("integer", "xresolution", {std::max(1.0, std::round(width))});
  list.add_numbers("integer", "yresolution", {std::max(1.0, std::round(height))});
  scene.film = std::move(list).directive("rgb");
}

double positive(const JsonValue& owner, const std::string& name) {
  const double value = owner.get(name).number();
  if (!(value > 0))
    owner.get(name).fail("this is " + std::to_string(value) + ", expected a number above 0");
  return value;
}

/// Returns the aspect ratio of the picture.
double describe_perspective(const JsonValue& camera, ParameterList& list) {
  constexpr double kUsualAspect = 16.0 / 9.0;
  const JsonValue perspective = camera.get("perspective");
  const double aspect =
      perspective.find("aspectRatio") ? positive(perspective, "aspectRatio") : kUsualAspect;
  const double vertical = positive(perspective, "yfov");
  if (!(vertical < kPiDouble))
    perspective.get("yfov").fail("this is " + std::to_string(vertical) +
                                 ", expected radians below pi");
  // pbrt's angle is that of the shorter side.
  const double angle = aspect >= 1 ? vertical : 2 * std::atan(aspect * std::tan(0.5 * vertical));
  list.add_float("fov", angle * 180 / kPiDouble);
  return aspect;
}

double describe_orthographic(const JsonValue& camera, ParameterList& list) {
  const JsonValue view = camera.get("orthographic");
  // Magnifications may be negative in old files; their sign has no meaning.
  const double x = std::abs(view.get("xmag").number()), y = std::abs(view.get("ymag").number());
  if (!(x > 0 && y > 0)) view.fail("\"xmag\" or \"ymag\" is 0, expected numbers other than 0");
  list.add_numbers("float", "screenwindow", {-x, x, -y, y});
  return x / y;
}

/// World to camera for pbrt's camera space, where z points forwards: glTF's camera looks along -z.
/// Without the scale of the node, which cameras do not have.
Mat44d world_to_camera(Mat44d node, const JsonValue& place) {
  for (int i = 0; i < 3; ++i) {
    const double length = Vec3d(node[i][0], node[i][1], node[i][2]).length();
    if (!(length > 0 && std::isfinite(length)))
      place.fail("the node of the camera is scaled to 0, expected a scale other than 0");
    for (int j = 0; j < 3; ++j) node[i][j] *= (i == 2 ? -1 : 1) / length;
  }
  if (!(std::abs(node.determinant()) > 0))
    place.fail("the transform of the camera has no inverse, expected one that can be inverted");
  return node.inverse();
}

}  // namespace

void add_camera(Document& document, const NodeGraph& nodes, SceneDescription& scene) {
  const std::vector<PlacedCamera> cameras = shown_cameras(document, nodes);
  if (cameras.empty()) {
    if (!document.options().camera.empty())
      document.root().fail("there is no camera \"" + document.options().camera +
                           "\": the shown scene has none");
    return;
  }
  for (const PlacedCamera& camera : cameras)
    scene.choices.cameras.push_back(
        camera.name.empty() ? std::to_string(scene.choices.cameras.size()) : camera.name);
  const PlacedCamera& chosen = chosen_camera(document, cameras);
  const JsonValue& place = document.list("nodes")[chosen.node];
  const std::string type = chosen.camera.get("type").text();
  ParameterList list(chosen.camera.where());
  double aspect = 1;
  if (type == "perspective")
    aspect = describe_perspective(chosen.camera, list);
  else if (type == "orthographic")
    aspect = describe_orthographic(chosen.camera, list);
  else
    chosen.camera.get("type").fail("unknown type \"" + type +
                                   "\", expected perspective or orthographic");
  if (!(aspect > 1e-3 && aspect < 1e3))
    chosen.camera.fail("the picture has an aspect ratio of " + std::to_string(aspect) +
                       ", expected one between 0.001 and 1000");
  add_film(scene, aspect, chosen.camera.where());
  CameraDescription camera;
  static_cast<DirectiveDescription&>(camera) = std::move(list).directive(type);
  const TransformDescription& world = nodes.world(chosen.node);
  camera.world_to_camera = {world_to_camera(world.start, place), world_to_camera(world.end, place)};
  camera.world_to_camera.start.multDirMatrix(Vec3d(0, 1, 0), camera.up);  // glTF's own up
  scene.camera = std::move(camera);
}

}  // namespace nephroid::gltf
