// The lights of --sun and --environment. It must not know cameras and shapes.
#pragma once

#include "input/import_options.h"
#include "input/scene_description.h"
#include "input/staging/surroundings.h"

namespace nephroid {

/// Replaces all lights at infinity by the sun (sky/preetham_sun.h) and a clear sky above grey
/// ground (sky/hosek_wilkie_sky.h). Returns the illuminance of a surface that faces the sun, in
/// lux.
double set_sun(SceneDescription* scene, const SunDirection& sun, const Surroundings& surroundings);

/// Replaces all infinite lights by the image of a file, whose name is relative to the current
/// directory. Without other lights, and shapes that emit more than `glow`, it gets an illuminance
/// of pi, so that a white surface under it has the value 1 at iso 100.
void set_environment(SceneDescription* scene, const std::string& file,
                     const Surroundings& surroundings, double glow);

}  // namespace nephroid
