// The choices that a glTF file offers: its material variants and animations.
#pragma once

#include "input/gltf/document.h"
#include "input/scene_description.h"

namespace nephroid::gltf {

/// Lists variants and animations in scene.choices. Warns if the user's moment is after the end of
/// all animations.
void add_choices(Document& document, SceneDescription& scene);

}  // namespace nephroid::gltf
