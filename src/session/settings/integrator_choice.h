// The integrator of a render and its settings: -D overrides the scene's Integrator line, which
// overrides the defaults. It must not know the rest of the scene.
#pragma once

#include <string>
#include <vector>

#include "input/scene_description.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// The integrator of a render if no routes are given.
inline const std::string kDefaultIntegrator = "mixed";

/// The integrator and settings chosen by scene and user.
struct IntegratorChoice {
  std::string name;
  RenderSettings settings;
  std::vector<std::string> notes;          ///< for the report: unused parameters of the scene
  std::vector<std::string> warnings;       ///< errors in parameters: "file:line:column: message"
  std::vector<std::string> unknown_names;  ///< warnings about names that the format lacks
};

/// `wanted` is an integrator's name, or "scene" for the one that corresponds to the scene's own.
/// With "scene", throws UsageError if none corresponds, SceneError if the scene's is unknown.
/// Throws SceneError for a parameter of the wrong type or range. Notes about pbrt-v4 are only for
/// its own scenes.
IntegratorChoice choose_integrator(const std::string& wanted, const std::string& scene_integrator,
                                   const ParameterSet& scene_parameters,
                                   const RenderSettings& settings, bool is_pbrt = true);

}  // namespace nephroid
