// One row per option; see scene_options.h.
#include "scene/scene_options.h"

#include <algorithm>
#include <string>
#include <vector>

#include "input/spelling.h"

namespace nephroid {
namespace {

bool is_on(const Parameter& option) {
  return !option.bools.empty() && option.bools[0];
}

struct Row {
  const char* name;
  void (*take)(const Parameter&, SceneOptions&);  ///< null: it has no effect here
  const char* why_not;
};

// pbrt-v4 decomposes the matrices of moving instances in its rendering space, so that their
// rotations turn about the origin of that. Nothing else here depends on it.
void take_coordinate_system(const Parameter& option, SceneOptions& options) {
  const std::string& name = option.strings[0];
  if (name != "camera" && name != "cameraworld" && name != "world")
    throw SceneError(option.where, "unknown rendering coordinate system \"" + name +
                                       "\", expected \"camera\", \"cameraworld\" or \"world\"");
  options.turn_about_camera = name != "world";
}

constexpr Row kTable[] = {
    {"disablepixeljitter", [](const Parameter& p, SceneOptions& o) { o.pixel_jitter = !is_on(p); },
     ""},
    {"disablewavelengthjitter",
     [](const Parameter& p, SceneOptions& o) { o.wavelength_jitter = !is_on(p); }, ""},
    {"forcediffuse", [](const Parameter& p, SceneOptions& o) { o.force_diffuse = is_on(p); }, ""},
    {"seed", [](const Parameter& p, SceneOptions& o) { o.seed = static_cast<int>(p.numbers[0]); },
     ""},
    {"rendercoordsys", take_coordinate_system, ""},
    // Textures are looked up at points, with or without it.
    {"disabletexturefiltering", [](const Parameter&, SceneOptions&) {}, ""},
    {"displacementedgescale",
     [](const Parameter& p, SceneOptions& o) {
       o.displacement_edge_scale = static_cast<float>(p.numbers[0]);
     },
     ""},
    {"msereferenceimage", nullptr, "; nephroid compare measures pictures"},
    {"msereferenceout", nullptr, "; nephroid compare measures pictures"},
    {"pixelstats", nullptr, ""},
    {"wavefront", nullptr, ""},
};

}  // namespace

SceneOptions read_scene_options(const SceneDescription& description, Diagnostics& diagnostics) {
  SceneOptions options;
  for (const Parameter& option : description.options) {
    const Row* row = std::find_if(std::begin(kTable), std::end(kTable),
                                  [&](const Row& r) { return option.name == r.name; });
    if (row == std::end(kTable)) continue;
    if (row->take)
      row->take(option, options);
    else if (option.type != "bool" || is_on(option))
      diagnostics.warn(option.where,
                       "option \"" + option.name + "\" has no effect here" + row->why_not);
  }
  return options;
}

void check_accelerator(const SceneDescription& description, Diagnostics& diagnostics) {
  static const std::vector<std::string> kKnown = {"bvh", "kdtree"};
  if (!description.accelerator) return;
  const std::string& type = description.accelerator->type;
  if (std::find(kKnown.begin(), kKnown.end(), type) == kKnown.end())
    diagnostics.warn(description.accelerator->where,
                     "unknown accelerator \"" + type + "\"" + did_you_mean(type, kKnown));
}

}  // namespace nephroid
