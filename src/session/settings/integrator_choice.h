// The integrator of a render and its settings: -D is over the scene's Integrator line, and that
// over the defaults. It must not know the rest of the scene.
#pragma once

#include <string>
#include <vector>

#include "input/scene_description.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// The integrator of a render if nothing names routes.
inline const std::string kDefaultIntegrator = "mixed";

/// What the scene and the user chose.
struct IntegratorChoice {
  std::string name;
  RenderSettings settings;
  std::vector<std::string> notes;     ///< parameters of the scene that are not used, for the report
  std::vector<std::string> warnings;  ///< errors in them: "file:line:column: message"
  std::vector<std::string> unknown_names;  ///< those of them about names that the format lacks
};

/// `wanted` is an integrator's name, or "scene" for the one that stands for the scene's own. Throws
/// UsageError if the scene's own is asked for and nothing stands for it, SceneError if it is asked
/// for and unknown, or for a parameter of the wrong type or range.
IntegratorChoice choose_integrator(const std::string& wanted, const std::string& scene_integrator,
                                   const ParameterSet& scene_parameters,
                                   const RenderSettings& settings);

}  // namespace nephroid
