// The medium around a scene, in which the light of infinite lights arrives. pbrt-v4 gives such
// lights no medium; here it follows from the camera's medium and the surfaces around it.
#pragma once

#include <optional>

#include "scene/scene.h"

namespace nephroid {

/// The medium in which straight lines from the camera leave the scene; null is empty space. Empty
/// if they leave it in different media.
std::optional<const Medium*> surrounding_medium(const Scene& scene);

}  // namespace nephroid
