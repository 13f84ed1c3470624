#include "route/scene_symbols.h"

#include <algorithm>
#include <map>
#include <utility>

#include "scene/shown_materials.h"

namespace nephroid {

LightKind kind_of(const Light& light) {
  if (light.is_area()) return LightKind::kShape;
  if (light.is_infinite()) return light.is_delta() ? LightKind::kDistant : LightKind::kEnvironment;
  return LightKind::kPoint;
}

namespace {

// 0 if no expression mentions names[i].
Label number_of(const std::vector<std::string>& names, size_t i,
                const std::vector<std::string>& labels) {
  if (i >= names.size()) return 0;
  const auto found = std::find(labels.begin(), labels.end(), names[i]);
  return found == labels.end() ? Label{0} : static_cast<Label>(found - labels.begin() + 1);
}

}  // namespace

SceneSymbols::SceneSymbols(const Scene& scene, const std::vector<std::string>& labels) {
  std::vector<bool> known(labels.size());
  const auto number = [&](const std::vector<std::string>& names, size_t i) {
    const Label label = number_of(names, i, labels);
    if (label > 0) known[label - 1u] = true;
    return label;
  };
  present_.events.assign(8 * (labels.size() + 1), false);
  present_.lights.assign(8 * (labels.size() + 1), false);

  std::vector<bool> called_mix(labels.size());
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Label label = number_of(scene.material_labels, i, labels);
    materials_.push_back(label);
    if (label > 0) (scene.materials[i]->is_mix() ? called_mix : known)[label - 1u] = true;
  }
  specular_band_ = scene.specular_band;
  find_surface_events(scene);
  find_lamps(scene);
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
        light_symbol(kind_of(*scene.lights[i]), number(scene.light_labels, i));
    lights_.push_back(symbol);
    present_.lights[symbol] = true;
  }
  for (size_t i = 0; i < labels.size(); ++i) {
    if (known[i]) continue;
    unknown_.push_back(labels[i]);
    unknown_is_mix_ = unknown_is_mix_ || called_mix[i];
  }
}

Lamp SceneSymbols::new_lamp(const std::string& name) {
  if (lamp_names_.size() == kMaxLamps)
    lamp_names_.back() = "other lights";
  else
    lamp_names_.push_back(name);
  return static_cast<Lamp>(lamp_names_.size() - 1);
}

void SceneSymbols::find_lamps(const Scene& scene) {
  std::map<std::string, Lamp> by_label;
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const auto known = by_label.find(scene.light_labels[i]);
    lamps_.push_back(known != by_label.end() ? known->second : new_lamp(name_of_light(scene, i)));
    by_label.emplace(scene.light_labels[i], lamps_.back());
  }
  for (size_t i = 0; i < scene.media.size(); ++i)
    lamps_of_media_.push_back(scene.media[i]->is_emissive() ? new_lamp(scene.medium_labels[i])
                                                            : Lamp{0});
}

void SceneSymbols::find_surface_events(const Scene& scene) {
  const MaterialsOfShapes shapes = materials_of_shapes(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = *scene.materials[i];
    if (material.is_interface()) continue;
    const bool merges = material.merges_photons();
    if (shapes.on_curves[i] || (shapes.on_surfaces[i] && !merges))
      present_.events[event_symbol(EventClass::kHair, false, materials_[i])] = true;
    if (!shapes.on_surfaces[i] || !merges) continue;
    for (const EventClass c : kSurfaceClasses)
      for (const bool transmitted : {false, true})
        if (contains(material.possible_classes(), c))
          present_.events[event_symbol(c, transmitted, materials_[i])] = true;
    if (contains(material.possible_classes(), EventClass::kGlossy))
      glossy_.push_back({name_of_material(scene, i), material.facet_alpha()});
  }
  std::stable_sort(glossy_.begin(), glossy_.end(),
                   [](const GlossyMaterial& a, const GlossyMaterial& b) {
                     return a.alpha.value_or(kInfinity) < b.alpha.value_or(kInfinity);
                   });
}

}  // namespace nephroid
