// Names and numbers of materials, media and lights; see scene_labels.h.
#include "scene/scene_labels.h"

#include <set>
#include <utility>

#include "scene/light/light_table.h"

namespace nephroid {
namespace {

/// Numbers unnamed things.
class Numbering {
 public:
  /// `names`: the names given in the file.
  explicit Numbering(std::set<std::string> names) : names_(std::move(names)) {}

  std::string label(const std::string& name, const std::string& type) {
    if (!name.empty()) return name;
    int& number = last_[type];
    std::string label;
    do {
      label = type + std::to_string(++number);
    } while (names_.count(label) != 0);
    return label;
  }

 private:
  std::set<std::string> names_;
  std::map<std::string, int> last_;
};

}  // namespace

std::vector<std::string> material_labels(const SceneDescription& description) {
  std::set<std::string> names;
  for (const MaterialDescription& m : description.materials) names.insert(m.name);
  Numbering numbering(std::move(names));
  std::vector<std::string> labels;
  for (const MaterialDescription& m : description.materials)
    labels.push_back(numbering.label(m.name, m.type.empty() ? "interface" : m.type));
  return labels;
}

std::vector<std::string> medium_labels(const SceneDescription& description) {
  std::vector<std::string> labels;
  for (const MediumDescription& m : description.media) labels.push_back(m.name);
  return labels;
}

LightLabels::LightLabels(const SceneDescription& description) {
  std::set<std::string> names;
  for (const LightDescription& light : description.lights)
    names.insert(light_name(light.parameters));
  for (const ShapeDescription& shape : description.shapes)
    if (shape.area_light) names.insert(light_name(shape.area_light->parameters));
  Numbering numbering(std::move(names));
  for (const LightDescription& light : description.lights)
    lights_.push_back(numbering.label(light_name(light.parameters), light.type));
  for (const ShapeDescription& shape : description.shapes) {
    if (!shape.area_light) continue;
    const DirectiveDescription& directive = *shape.area_light;
    const auto [entry, is_new] = area_lights_.try_emplace(place(directive));
    if (is_new) entry->second = numbering.label(light_name(directive.parameters), directive.type);
  }
}

}  // namespace nephroid
