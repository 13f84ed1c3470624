// Names in a scene that pbrt-v4 does not have. It must not know their meaning.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid {

/// Comment lines that list the names of this program's dialect in the scene; empty if there are
/// none.
std::string dialect_note(const SceneDescription& scene);

}  // namespace nephroid
