// Mitsuba's integrators by the names of pbrt-v4, for --integrator scene.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// Sets the integrator. One that is unknown is left out with a warning.
void write_integrator(ImportContext& context, const Object& object);

std::vector<Plugin> integrator_plugins();

}  // namespace nephroid::mitsuba
