#include "session/settings/short_paths.h"

#include <fmt/format.h>

#include <optional>

#include "scene/shown_materials.h"

namespace nephroid {
namespace {

/// Events into and out of a closed body. Seeing or lighting a surface behind it takes one more.
constexpr int kEventsThroughGlass = 2;
/// Events at a mirror. Seeing a lit surface in it takes one more.
constexpr int kEventsAtMirror = 1;

/// The first material on a shape for which `is_wanted` is true.
template <class IsWanted>
std::optional<size_t> first_material(const Scene& scene, const IsWanted& is_wanted) {
  const MaterialsOfShapes shown = materials_of_shapes(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i)
    if ((shown.on_surfaces[i] || shown.on_curves[i]) && is_wanted(*scene.materials[i])) return i;
  return std::nullopt;
}

/// True for metal and thin glass.
bool mirrors_only(const Material& material) {
  const ClassMask classes = material.possible_classes();
  return !material.refracts() && !contains(classes, EventClass::kDiffuse) &&
         (contains(classes, EventClass::kSpecular) || contains(classes, EventClass::kGlossy));
}

}  // namespace

std::vector<std::string> notes_of_short_paths(const Scene& scene, const RenderSettings& settings) {
  const int depth = settings.integrator.max_depth;
  const std::string ends =
      fmt::format("{}{} ends paths",
                  settings.gives("max-depth") ? "-D max-depth=" : "the scene's maxdepth ", depth);
  if (depth == 0) return {ends + " at the first surface: only lights are visible"};
  std::vector<std::string> notes;
  if (depth <= kEventsThroughGlass) {
    const auto glass =
        first_material(scene, [](const Material& material) { return material.refracts(); });
    if (glass)
      notes.push_back(fmt::format(
          "{} {} {}: it lights nothing behind it and {}, expected at least {} scattering events",
          ends, depth < kEventsThroughGlass ? "inside" : "behind", name_of_material(scene, *glass),
          depth < kEventsThroughGlass ? "only lights in it are seen"
                                      : "only lights are seen through it",
          kEventsThroughGlass + 1));
  }
  if (depth <= kEventsAtMirror) {
    const auto mirror = first_material(scene, mirrors_only);
    if (mirror)
      notes.push_back(
          fmt::format("{} at {}: it reflects only lights, expected at least {} scattering events",
                      ends, name_of_material(scene, *mirror), kEventsAtMirror + 1));
  }
  return notes;
}

}  // namespace nephroid
