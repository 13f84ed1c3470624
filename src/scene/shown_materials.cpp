#include "scene/shown_materials.h"

namespace nephroid {
namespace {

/// Calls visit(record) for each shape, including those of objects that are never placed.
template <class Visit>
void for_each_shape(const Scene& scene, const Visit& visit) {
  const auto each = [&](const ShapeGroup& group) {
    for (const ShapeRecord& record : group.records) visit(record);
  };
  each(scene.top);
  for (const auto& group : scene.groups) each(*group);
  for (const auto& group : scene.moving_shapes) each(*group);
}

/// Adds to `found`, by index, the materials that `material` can resolve to.
void add_guises(const Material& material, std::vector<bool>& visited, std::vector<bool>& found) {
  const auto index = static_cast<size_t>(material.index());
  if (visited[index]) return;
  visited[index] = true;
  if (!material.is_mix()) found[index] = true;
  for (const MaterialPtr& choice : material.choices()) add_guises(*choice, visited, found);
}

std::string named(const std::vector<std::string>& labels, const std::vector<SourceLocation>& places,
                  size_t i) {
  const std::string where = i < places.size() ? places[i].to_string() : std::string();
  return where.empty() ? labels[i] : labels[i] + " (" + where + ")";
}

}  // namespace

MaterialsOfShapes materials_of_shapes(const Scene& scene) {
  const size_t count = scene.materials.size();
  MaterialsOfShapes result{std::vector<bool>(count), std::vector<bool>(count)};
  std::vector<bool> visited_on_surfaces(count), visited_on_curves(count);
  for_each_shape(scene, [&](const ShapeRecord& record) {
    const Material& material = *scene.materials[record.material];
    if (record.merges_photons)
      add_guises(material, visited_on_surfaces, result.on_surfaces);
    else
      add_guises(material, visited_on_curves, result.on_curves);
  });
  return result;
}

std::string name_of_material(const Scene& scene, size_t index) {
  return named(scene.material_labels, scene.material_places, index);
}

std::string name_of_light(const Scene& scene, size_t index) {
  return named(scene.light_labels, scene.light_places, index);
}

}  // namespace nephroid
