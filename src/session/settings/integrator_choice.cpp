#include "session/settings/integrator_choice.h"

#include <fmt/format.h>

#include <optional>

#include "integrator/presets/integrator_table.h"

namespace nephroid {
namespace {

/// Applies the scene's Integrator line. The radius of pbrt's sppm is in world units and made for
/// its own photon counts. Ours is in pixel footprints, so theirs is only mentioned.
void take_scene_parameters(const ParameterSet& parameters, bool follow_scene,
                           IntegratorChoice* choice) {
  constexpr int kAbsent = -1;
  IntegratorOptions& options = choice->settings.integrator;
  const bool depth_is_given = choice->settings.gives("max-depth");
  const Parameter* depth = parameters.find("maxdepth");
  const int max_depth = parameters.get_int("maxdepth", kAbsent);
  if (depth != nullptr && max_depth < 0)
    throw SceneError(depth->where,
                     fmt::format("\"maxdepth\" is {}, expected at least 0", max_depth));
  if (depth != nullptr && !depth_is_given) options.max_depth = max_depth;
  if (parameters.find("radius") != nullptr)
    choice->notes.push_back(
        "the scene's photon radius in world units is not used: radii are chosen by the size of a "
        "pixel (-D radius=PIXELS)");
  const int photons = parameters.get_int("photonsperiteration", kAbsent);
  if (photons > 0 && follow_scene && !choice->settings.gives("photons"))
    options.photons_per_pass = photons;
}

/// The format type of a pbrt-v4 integrator; empty if the name is unknown.
std::optional<FormatType> pbrt_integrator(const std::string& name) {
  for (const FormatType& type : scene_integrator_types())
    if (name == type.name) return type;
  return std::nullopt;
}

std::string pbrt_integrator_names() {
  std::string names;
  for (const FormatType& type : scene_integrator_types())
    names += (names.empty() ? "" : ", ") + std::string(type.name);
  return names;
}

/// The integrator that corresponds to the scene's own.
std::string integrator_of_scene(const std::string& scene_integrator, const SourceLocation& where) {
  // Without an Integrator line pbrt-v4 renders with volpath.
  const std::string own = scene_integrator.empty() ? "volpath" : scene_integrator;
  if (!pbrt_integrator(own))
    throw SceneError(where, fmt::format("unknown integrator \"{}\", expected one of: {}", own,
                                        pbrt_integrator_names()));
  std::string name = integrator_for_scene_name(own);
  if (name.empty())
    throw UsageError(
        fmt::format("--integrator scene: the scene's integrator '{}' has no equivalent here, "
                    "expected the name of an integrator",
                    own));
  return name;
}

/// Warns of names that pbrt-v4 does not have; they have no effect.
void warn_of_unknown_names(const std::string& scene_integrator, const ParameterSet& parameters,
                           IntegratorChoice* choice) {
  Diagnostics diagnostics;
  const std::string own = scene_integrator.empty() ? "volpath" : scene_integrator;
  const std::optional<FormatType> type = pbrt_integrator(own);
  if (!type) {
    diagnostics.warn_of_unknown_name(
        parameters.where,
        fmt::format("unknown integrator \"{}\", \"{}\" is used", scene_integrator, choice->name));
  } else {
    if (parameters.get_bool("regularize", false))
      diagnostics.warn(parameters.find("regularize")->where,
                       "\"regularize\" has no effect here: caustics are rendered without it");
    parameters.report_unused("integrator \"" + own + "\"", *type, diagnostics);
  }
  for (const Warning& warning : diagnostics.warnings()) {
    choice->warnings.push_back(located(warning.where, warning.message));
    if (warning.is_unknown_name) choice->unknown_names.push_back(choice->warnings.back());
  }
}

}  // namespace

IntegratorChoice choose_integrator(const std::string& wanted, const std::string& scene_integrator,
                                   const ParameterSet& scene_parameters,
                                   const RenderSettings& settings, bool is_pbrt) {
  IntegratorChoice choice;
  const bool follow_scene = wanted == "scene";
  choice.name =
      follow_scene ? integrator_of_scene(scene_integrator, scene_parameters.where) : wanted;
  choice.settings = settings;
  const bool gives_depth =
      scene_parameters.peek("maxdepth") != nullptr || settings.gives("max-depth");
  if (is_pbrt && !scene_integrator.empty() && !gives_depth)
    choice.notes.push_back(fmt::format(
        "the scene's Integrator gives no maxdepth: paths have up to {} scattering "
        "events; pbrt-v4 would stop at 5, too few for glass (-D max-depth=5 to compare)",
        settings.integrator.max_depth));
  take_scene_parameters(scene_parameters, follow_scene, &choice);
  warn_of_unknown_names(scene_integrator, scene_parameters, &choice);
  return choice;
}

}  // namespace nephroid
