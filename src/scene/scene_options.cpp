// One row per option; see scene_options.h.
#include "scene/scene_options.h"

#include "input/option_directive.h"
#include "input/spelling.h"

namespace nephroid {
namespace {

bool is_on(const Parameter& option) {
  return !option.bools.empty() && option.bools[0];
}

// pbrt-v4 decomposes the matrices of moving instances in its rendering space, so that they rotate
// about its origin. Nothing else here depends on that space.
void take_coordinate_system(const Parameter& option, SceneOptions& options) {
  const std::string& name = option.strings[0];
  if (name != "camera" && name != "cameraworld" && name != "world")
    throw SceneError(option.where, "unknown rendering coordinate system \"" + name +
                                       "\", expected \"camera\", \"cameraworld\" or \"world\"");
  options.turn_about_camera = name != "world";
}

/// Options that change images; input/option_directive.cpp has the names of all options.
struct OptionRow {
  const char* name;
  void (*take)(const Parameter&, SceneOptions&);
};
constexpr OptionRow kOptionTable[] = {
    {"disablepixeljitter", [](const Parameter& p, SceneOptions& o) { o.pixel_jitter = !is_on(p); }},
    {"disablewavelengthjitter",
     [](const Parameter& p, SceneOptions& o) { o.wavelength_jitter = !is_on(p); }},
    {"forcediffuse", [](const Parameter& p, SceneOptions& o) { o.force_diffuse = is_on(p); }},
    {"seed", [](const Parameter& p, SceneOptions& o) { o.seed = static_cast<int>(p.numbers[0]); }},
    {"displacementedgescale",
     [](const Parameter& p, SceneOptions& o) {
       o.displacement_edge_scale = static_cast<float>(p.numbers[0]);
     }},
    {"rendercoordsys", take_coordinate_system},
};

constexpr const char* kOneAccelerator = "there is one accelerator, and it has no settings";

constexpr FormatParameter kBvh[] = {
    {"integer", "maxnodeprims", "4", "", kOneAccelerator, Support::kNotNeeded},
    {"string", "splitmethod", "sah", "", kOneAccelerator, Support::kNotNeeded},
};
constexpr FormatParameter kKdTree[] = {
    {"integer", "intersectcost", "5", "", kOneAccelerator, Support::kNotNeeded},
    {"integer", "traversalcost", "1", "", kOneAccelerator, Support::kNotNeeded},
    {"float", "emptybonus", "0.5", "", kOneAccelerator, Support::kNotNeeded},
    {"integer", "maxprims", "1", "", kOneAccelerator, Support::kNotNeeded},
    {"integer", "maxdepth", "-1", "", kOneAccelerator, Support::kNotNeeded},
};
constexpr FormatType kAccelerators[] = {
    {"bvh", {kBvh}, kOneAccelerator, Support::kNotNeeded},
    {"kdtree", {kKdTree}, kOneAccelerator, Support::kNotNeeded},
};

}  // namespace

SceneOptions read_scene_options(const SceneDescription& description, Diagnostics& diagnostics) {
  SceneOptions options;
  for (const Parameter& option : description.options) {
    for (const OptionRow& row : kOptionTable)
      if (option.name == row.name) row.take(option, options);
    for (const FormatParameter& known : format_options())
      if (option.name == known.name && known.support == Support::kWarned &&
          (option.type != "bool" || is_on(option)))
        diagnostics.warn(option.where, "option \"" + option.name + "\" has no effect here" +
                                           (*known.note ? "; " : "") + known.note);
  }
  return options;
}

std::vector<FormatType> accelerator_types() {
  return format_types(kAccelerators);
}

void check_accelerator(const SceneDescription& description, Diagnostics& diagnostics) {
  if (!description.accelerator) return;
  const std::string& type = description.accelerator->type;
  if (const FormatType* row = find_row(kAccelerators, type)) {
    description.accelerator->parameters.report_unused("accelerator \"" + type + "\"", *row,
                                                      diagnostics);
    return;
  }
  std::vector<std::string> names;
  for (const FormatType& known : kAccelerators) names.emplace_back(known.name);
  diagnostics.warn_of_unknown_name(
      description.accelerator->where,
      "unknown accelerator \"" + type + "\"" + did_you_mean(type, names));
}

}  // namespace nephroid
