// Mitsuba's emitters as lights of pbrt-v4.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// Adds an emitter that belongs to no shape.
void write_emitter(ImportContext& context, const Object& object);

/// The light of a shape, with the name of the emitter or else of the shape. Throws SceneError if
/// the emitter is no area light.
DirectiveDescription area_light(ImportContext& context, const Object& object,
                                const std::string& name_of_shape);

std::vector<Plugin> emitter_plugins();

}  // namespace nephroid::mitsuba
