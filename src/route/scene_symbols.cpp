// Labels of a scene as numbers, and which symbols its materials, media and lights can give.
// Who calls it: through scene_symbols.h. It must not know walks.
#include "route/scene_symbols.h"

#include <algorithm>
#include <utility>

namespace nephroid {
namespace {

LightKind kind_of_light(const Light& light) {
  if (light.is_area()) return LightKind::kShape;
  if (light.is_infinite()) return light.is_delta() ? LightKind::kDistant : LightKind::kEnvironment;
  return LightKind::kPoint;
}

// True if photons cannot be merged on some shape, whatever its material.
bool any_shape_refuses_photons(const Scene& scene) {
  const auto refuses = [](const ShapeGroup& group) {
    return std::any_of(group.records.begin(), group.records.end(),
                       [](const ShapeRecord& r) { return !r.merges_photons; });
  };
  const auto any_of = [&](const std::vector<std::unique_ptr<ShapeGroup>>& groups) {
    return std::any_of(groups.begin(), groups.end(), [&](const auto& g) { return refuses(*g); });
  };
  return refuses(scene.top) || any_of(scene.groups) || any_of(scene.moving_shapes);
}

}  // namespace

// Materials that no shape names count as well: a mix may stand for them.
SceneSymbols::SceneSymbols(const Scene& scene, const std::vector<std::string>& labels) {
  std::vector<bool> known(labels.size());
  const auto number = [&](const std::vector<std::string>& names, size_t i) -> Label {
    if (i >= names.size()) return 0;
    const auto found = std::find(labels.begin(), labels.end(), names[i]);
    if (found == labels.end()) return 0;
    known[static_cast<size_t>(found - labels.begin())] = true;
    return static_cast<Label>(found - labels.begin() + 1);
  };
  present_.events.assign(8 * (labels.size() + 1), false);
  present_.lights.assign(8 * (labels.size() + 1), false);

  const bool curves = any_shape_refuses_photons(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = *scene.materials[i];
    const Label label = number(scene.material_labels, i);
    materials_.push_back(label);
    if (material.is_interface()) continue;
    if (curves || !material.merges_photons())
      present_.events[event_symbol(EventClass::kHair, false, label)] = true;
    if (!material.merges_photons()) continue;
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(material.possible_classes(), c)) continue;
      // Knows which materials shapes have.
      if (c == EventClass::kSpecular && !scene.has_specular_material) continue;
      for (const bool transmitted : {false, true})
        present_.events[event_symbol(c, transmitted, label)] = true;
    }
  }
  for (size_t i = 0; i < scene.media.size(); ++i) {
    const Medium& medium = *scene.media[i];
    const Label label = number(scene.medium_labels, i);
    media_.push_back(label);
    if (!medium.is_purely_absorbing())
      present_.events[event_symbol(EventClass::kVolume, false, label)] = true;
    if (medium.is_emissive()) present_.lights[light_symbol(LightKind::kMedium, label)] = true;
  }
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const LightSymbol symbol =
        light_symbol(kind_of_light(*scene.lights[i]), number(scene.light_labels, i));
    lights_.push_back(symbol);
    present_.lights[symbol] = true;
  }
  for (size_t i = 0; i < labels.size(); ++i)
    if (!known[i]) unknown_.push_back(labels[i]);
}

}  // namespace nephroid
