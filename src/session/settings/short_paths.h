// Light that a small max-depth leaves out. It must not know integrators.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// Notes on things of the scene that look black because paths end too early. A path may have
/// `max_depth` scattering events, the one at which a lamp is sampled among them; the ways straight
/// through thin glass are none.
std::vector<std::string> notes_of_short_paths(const Scene& scene, const RenderSettings& settings);

}  // namespace nephroid
