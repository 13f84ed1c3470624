// The exposure that a scene's light asks for, where its file has none.
#pragma once

#include "input/scene_description.h"

namespace nephroid {

/// Illuminance in lux of well lit surfaces that face the light: three quarters of the lit surfaces
/// in the picture have less. Surfaces do not hide each other, and nothing casts a shadow
/// (illumination.h). Without a camera, or surfaces in its view, all surfaces count. 0 if no light
/// reaches a mesh.
double typical_illuminance(const SceneDescription& scene);

}  // namespace nephroid
