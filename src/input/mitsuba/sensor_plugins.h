// Mitsuba's sensors, films, reconstruction filters and samplers as directives of pbrt-v4.
#pragma once

#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// Sets camera, film, pixel filter and sampler. `scene_name` names the picture.
void write_sensor(ImportContext& context, const Object& object, const std::string& scene_name);

std::vector<Plugin> sensor_plugins();

}  // namespace nephroid::mitsuba
