// The option "forcediffuse": every surface is Lambertian with the reflectance that its own material
// has for the direction from which it is seen, reflection and transmission together.
// Who calls it: the table of materials. It must not know which material it stands for.
#pragma once

#include "scene/material/material.h"

namespace nephroid {

/// The Lambertian stand-in for a material that is neither an interface nor a mix. Its reflectance
/// is an estimate from a few samples, drawn by a hash of the point, the direction and the
/// wavelength.
std::shared_ptr<Material> force_diffuse(MaterialPtr material);

}  // namespace nephroid
