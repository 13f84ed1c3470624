// Mitsuba's models of subsurface scattering as materials of pbrt-v4.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// The surface of a shape with subsurface scattering below `boundary`, the BSDF of the shape. It is
/// written at its first use.
Surface write_subsurface(ImportContext& context, const Object& object, const Surface& boundary);

std::vector<Plugin> subsurface_plugins();

}  // namespace nephroid::mitsuba
