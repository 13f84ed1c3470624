// The exposure that a scene's light asks for, where its file has none. It must not know cameras.
#pragma once

#include "input/scene_description.h"

namespace nephroid {

/// Illuminance of well lit surfaces that face the light, in lux: three quarters of the vertices
/// that any light reaches have less. Nothing casts a shadow, and the mean luminance of images is
/// not read but assumed. 0 if no light reaches a vertex.
double typical_illuminance(const SceneDescription& scene);

}  // namespace nephroid
