#include "input/gltf/lights.h"

#include <utility>

#include "core/color.h"
#include "input/gltf/textures.h"

namespace nephroid::gltf {
namespace {

constexpr double kDegreesPerRadian = 180 / kPiDouble;

void add_cone(const JsonValue& light, ParameterList& list) {
  const std::optional<JsonValue> spot = light.find_object("spot");
  const double inner = spot ? spot->get_number("innerConeAngle", 0) : 0;
  const double outer =
      spot ? spot->get_number("outerConeAngle", 0.785398163397448) : 0.785398163397448;
  // Equal angles are a sharp edge, which exporters write although the specification forbids it.
  if (!(inner >= 0 && outer >= inner && outer > 0 && outer <= 1.5707964))
    light.get("spot").fail("the angles of the cone are " + std::to_string(inner) + " and " +
                           std::to_string(outer) +
                           " radians, expected 0 <= inner <= outer <= pi/2 and outer > 0");
  list.add_float("coneangle", outer * kDegreesPerRadian);
  list.add_float("conedeltaangle", (outer - inner) * kDegreesPerRadian);
}

/// The node's transform without its scale, which lights do not have.
Mat44d rigid(Mat44d node) {
  for (int i = 0; i < 3; ++i) {
    const double length = Vec3d(node[i][0], node[i][1], node[i][2]).length();
    for (int j = 0; length > 0 && j < 3; ++j) node[i][j] /= length;
  }
  return node;
}

void add_punctual(const JsonValue& light, const TransformDescription& world,
                  SceneDescription& scene) {
  const std::string type = light.get("type").text();
  const ParameterList::Color color = light.get_numbers<3>("color", {1, 1, 1});
  const double intensity = light.get_number("intensity", 1);
  const ParameterList::Color emission = {color[0] * intensity, color[1] * intensity,
                                         color[2] * intensity};
  ParameterList list(light.where());
  if (type == "directional") {
    list.add_color("L", emission);
    list.add_numbers("point3", "to", {0, 0, -1});
  } else if (type == "point" || type == "spot") {
    list.add_color("I", emission);
  } else {
    light.get("type").fail("unknown type \"" + type + "\", expected directional, point or spot");
  }
  if (type == "spot") {
    list.add_numbers("point3", "to", {0, 0, -1});
    add_cone(light, list);
  }
  const std::string name = light.get_text("name", "");
  if (!name.empty()) list.add_string("name", name);
  LightDescription description;
  static_cast<DirectiveDescription&>(description) =
      std::move(list).directive(type == "directional" ? "distant" : type);
  description.transform = {rigid(world.start), rigid(world.end)};
  scene.lights.push_back(std::move(description));
}

void add_punctual_lights(Document& document, const NodeGraph& nodes, SceneDescription& scene) {
  const auto root = document.root().extension("KHR_lights_punctual");
  if (!root) return;
  const std::vector<JsonValue> lights = root->get("lights").elements();
  for (const size_t index : nodes.shown()) {
    const auto use = document.list("nodes")[index].extension("KHR_lights_punctual");
    if (!use) continue;
    const size_t light = use->get_index("light");
    if (light >= lights.size())
      use->get("light").fail("there is no light " + std::to_string(light) +
                             ", expected an index below " + std::to_string(lights.size()));
    if (lights[light].get_number("intensity", 1) > 0)
      add_punctual(lights[light], nodes.world(index), scene);
  }
}

/// The light of EXT_lights_image_based that the scene uses; empty if there is none.
std::optional<JsonValue> find_image_based_light(Document& document) {
  const std::optional<JsonValue> shown = chosen_scene(document);
  const auto use = shown ? shown->extension("EXT_lights_image_based") : std::nullopt;
  if (!use) return std::nullopt;
  const JsonValue root = document.root();
  const auto extension = root.extension("EXT_lights_image_based");
  if (!extension)
    root.fail(
        "the scene has a light of EXT_lights_image_based, but the file has no list of such lights");
  const std::vector<JsonValue> lights = extension->get("lights").elements();
  const size_t index = use->get_index("light");
  if (index >= lights.size())
    use->get("light").fail("there is no light " + std::to_string(index) +
                           ", expected an index below " + std::to_string(lights.size()));
  return lights[index];
}

/// The mean luminance of the surroundings over pi / Y00 is the first coefficient of the irradiance,
/// in real spherical harmonics (Ramamoorthi and Hanrahan 2001).
std::optional<double> mean_luminance(const JsonValue& light) {
  constexpr double kMeanOfFirst = 0.28209479177387814 / kPiDouble;
  const std::optional<JsonValue> list = light.find_array("irradianceCoefficients");
  if (!list || list->elements().empty()) return std::nullopt;
  std::vector<float> rgb;
  for (const JsonValue& number : list->elements().front().elements())
    rgb.push_back(static_cast<float>(number.number()));
  if (rgb.size() != 3) return std::nullopt;
  return kMeanOfFirst * RgbColorSpace::srgb().to_xyz({rgb[0], rgb[1], rgb[2]}).y;
}

/// An infinite light with the sharpest cube of the light. The blurred ones and the irradiance are
/// for rasterizers.
void add_image_based_light(Document& document, SceneDescription& scene) {
  const std::optional<JsonValue> light = find_image_based_light(document);
  const double intensity = light ? light->get_number("intensity", 1) : 0;
  if (!(intensity > 0)) return;
  const JsonValue cubes = light->get("specularImages");
  if (cubes.elements().empty()) cubes.fail("this list is empty, expected the six faces of a cube");
  const std::vector<JsonValue> faces = cubes.elements().front().elements();
  if (faces.size() != 6)
    cubes.fail("the cube has " + std::to_string(faces.size()) + " faces, expected 6");
  Textures textures(document, scene);
  std::vector<std::string> names;
  for (const JsonValue& face : faces) names.push_back(textures.image_file(face.index(), face));
  ParameterList list(light->where());
  list.add_strings("faces", std::move(names));
  if (intensity != 1) list.add_float("scale", intensity);
  const std::string name = light->get_text("name", "");
  if (!name.empty()) list.add_string("name", name);
  NodePose pose;
  pose.rotation = light->get_numbers<4>("rotation", pose.rotation);
  LightDescription description;
  static_cast<DirectiveDescription&>(description) = std::move(list).directive("infinite");
  description.transform = {matrix_of(pose), matrix_of(pose)};
  description.mean_luminance = mean_luminance(*light);
  scene.lights.push_back(std::move(description));
}

}  // namespace

void add_lights(Document& document, const NodeGraph& nodes, SceneDescription& scene) {
  add_punctual_lights(document, nodes, scene);
  add_image_based_light(document, scene);
}

}  // namespace nephroid::gltf
