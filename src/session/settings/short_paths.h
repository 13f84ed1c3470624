// Notes on light that is lost by a small max-depth. It must not know integrators.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// Notes on objects that look black because paths end too early. A path may have `max_depth`
/// scattering events, including the one where a light is sampled. Straight-through events of thin
/// glass do not count.
std::vector<std::string> notes_of_short_paths(const Scene& scene, const RenderSettings& settings);

}  // namespace nephroid
