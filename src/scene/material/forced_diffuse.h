// The option "forcediffuse": every surface becomes Lambertian, with the reflectance of its own
// material in the viewing direction, reflection and transmission together. It must not know the
// material that it replaces.
#pragma once

#include "scene/material/material.h"

namespace nephroid {

/// The Lambertian replacement of a material that is neither an interface nor a mix. Its reflectance
/// is an estimate from a few samples, drawn by a hash of point, direction and wavelength.
std::shared_ptr<Material> force_diffuse(MaterialPtr material);

}  // namespace nephroid
