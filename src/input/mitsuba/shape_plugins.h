// Mitsuba's shapes as shapes, objects and instances of pbrt-v4.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// Adds a shape of the scene to the description. A shape group becomes an object.
void write_shape(ImportContext& context, const Object& object);

std::vector<Plugin> shape_plugins();

}  // namespace nephroid::mitsuba
