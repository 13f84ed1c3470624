// `nephroid info`: describes a scene, from its description and its built form, or a picture.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unordered_map>
#include <utility>

#include "apps/commands.h"
#include "apps/messages.h"
#include "core/counted.h"
#include "integrator/presets/integrator_table.h"
#include "scene/embree_scene.h"
#include "session/checkpoint/picture_description.h"
#include "session/process_memory.h"
#include "session/scene_loading.h"
#include "session/settings/integrator_choice.h"

namespace nephroid {
namespace {

/// Triangles of a group; `other` counts the primitives of all other shapes.
uint64_t count_triangles(const ShapeGroup& group, uint64_t* other) {
  uint64_t triangles = 0;
  for (const ShapeRecord& record : group.records) {
    const uint64_t primitives = record.shape->primitive_count();
    if (dynamic_cast<const TriangleMesh*>(record.shape.get()) != nullptr)
      triangles += primitives;
    else
      *other += primitives;
  }
  return triangles;
}

void print_geometry(const Scene& scene) {
  uint64_t other = 0;
  uint64_t triangles = count_triangles(scene.top, &other);
  for (const auto* groups : {&scene.groups, &scene.moving_shapes})
    for (const auto& group : *groups) triangles += count_triangles(*group, &other);
  fmt::print("shapes: {} ({}, {}), {} of {}\n", scene.shape_count, counted(triangles, "triangle"),
             counted(other, "other primitive"), counted(scene.instance_count, "instance"),
             counted(scene.groups.size(), "object"));
  const Bounds3f bounds = scene.top.accelerator->bounds();
  if (bounds.isEmpty())
    fmt::print("extents: nothing\n");
  else
    fmt::print("extents: {:g} {:g} {:g} to {:g} {:g} {:g}, radius {:g}\n", bounds.min.x,
               bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z,
               scene.sphere.radius);
}

void print_film(const Scene& scene) {
  const FilmDescription& film = scene.film;
  fmt::print("resolution: {}x{}\n", film.width, film.height);
  if (film.crop_x0 != 0 || film.crop_y0 != 0 || film.crop_x1 != film.width ||
      film.crop_y1 != film.height)
    fmt::print("crop: x {} to {}, y {} to {}\n", film.crop_x0, film.crop_x1, film.crop_y0,
               film.crop_y1);
}

void print_lights(const Scene& scene) {
  uint64_t infinite = 0, delta = 0;
  for (const LightPtr& light : scene.lights) {
    if (light->is_infinite()) ++infinite;
    if (light->is_delta()) ++delta;
  }
  fmt::print("lights: {} (each emitting primitive counts), {} infinite, {} without extent\n",
             scene.lights.size(), infinite, delta);
}

/// "glass [S, line 12]": label, event classes and line of each material; glTF has no lines. A mix
/// has the labels of its materials, so it is left out.
std::vector<std::string> labels_of_materials(const SceneDescription& description,
                                             const Scene& scene) {
  std::vector<std::string> labels;
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = *scene.materials[i];
    if (material.is_mix() || material.is_interface()) continue;
    std::string classes;
    for (const EventClass c : kSurfaceClasses)
      if (contains(material.possible_classes(), c)) classes += "DGS"[static_cast<size_t>(c)];
    const SourceLocation where =
        i < description.materials.size() ? description.materials[i].where : SourceLocation{};
    if (!material.merges_photons()) classes = "H";
    const std::string line = where.line > 0 ? fmt::format(", line {}", where.line) : "";
    labels.push_back(fmt::format("{} [{}{}]", scene.material_labels[i], classes, line));
  }
  return labels;
}

/// Prints the labels for `--route` and `--aov`, each once with its number of occurrences.
void print_labels(const char* kind, const std::vector<std::string>& labels) {
  std::vector<std::pair<std::string, size_t>> counts;
  std::unordered_map<std::string, size_t> places;
  for (const std::string& label : labels) {
    const auto [place, is_new] = places.try_emplace(label, counts.size());
    if (is_new) counts.emplace_back(label, 0);
    ++counts[place->second].second;
  }
  std::string text;
  for (const auto& [label, count] : counts) {
    if (!text.empty()) text += ", ";
    text += count == 1 ? label : fmt::format("{} ({})", label, count);
  }
  fmt::print("labels of {}: {}\n", kind, text.empty() ? "none" : text);
}

const char* caustics_of(const Scene& scene) {
  if (scene.has_specular_material) return "some specular: caustics are possible";
  for (const MaterialPtr& material : scene.materials)
    if (contains(material->possible_classes(), EventClass::kGlossy))
      return "none specular, some glossy: caustics are a part of the diffuse light";
  return "none specular or glossy: there can be no caustics";
}

void print_integrator(const Scene& scene) {
  const std::string& own = scene.integrator;
  const std::string here = integrator_for_scene_name(own.empty() ? "volpath" : own);
  fmt::print("integrator: {}, or with --integrator scene: {} (the scene names {})\n",
             kDefaultIntegrator, here.empty() ? "not available" : here, own.empty() ? "none" : own);
  fmt::print("pixel samples: {}\n", scene.samples_per_pixel);
}

/// Prints the names that the options about scenes choose among.
void print_choices(const FileChoices& choices) {
  const auto print = [](const char* kind, const char* option,
                        const std::vector<std::string>& names) {
    if (!names.empty()) fmt::print("{} ({}): {}\n", kind, option, fmt::join(names, "; "));
  };
  print("cameras of the file", "--camera", choices.cameras);
  print("material variants", "--variant", choices.variants);
  print("animations", "--at", choices.animations);
  print("parameters of the file", "--define", choices.parameters);
}

}  // namespace

int run_info(const InfoCommand& command) {
  if (is_picture(command.file)) {
    fmt::print("{}", description_of_picture(command.file));
    return static_cast<int>(ExitStatus::kDone);
  }
  SceneOverrides overrides;
  overrides.import = command.import;
  MemoryLimit limit;
  limit.set(machine_memory(), bytes_of_stacks_to_come(0));
  const LoadedScene loaded = load_scene(command.file, overrides);
  print_warnings(loaded.warnings);
  print_notes(loaded.notes);
  const Scene& scene = *loaded.scene;
  fmt::print("scene: {}\n", command.file);
  print_film(scene);
  fmt::print("camera: {}\n", loaded.description.camera ? loaded.description.camera->type
                                                       : std::string("perspective (default)"));
  print_choices(loaded.description.choices);
  print_integrator(scene);
  print_geometry(scene);
  fmt::print("materials: {}, {}\n", scene.materials.size(), caustics_of(scene));
  print_lights(scene);
  print_labels("lights", scene.light_labels);
  print_labels("materials", labels_of_materials(loaded.description, scene));
  print_labels("media", scene.medium_labels);
  fmt::print("warnings: {}\n", loaded.warnings.size());
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
