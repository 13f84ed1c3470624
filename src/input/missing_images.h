// Finds the images that a scene names and that do not exist, before the first one is opened: a user
// wants to know of all of them at once. It must not know formats.
#pragma once

#include "input/scene_description.h"

namespace nephroid {

/// Throws SceneError at the first missing image with the names and places of all, if two or more
/// are missing. A single one is an error of its reader, which knows the reason.
void refuse_missing_images(const SceneDescription& scene);

}  // namespace nephroid
