// A SceneDescription as text, one fact per line, to compare with the files in golden/.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid::testing {

/// All of the description, then the warnings. Locations omit their directory.
std::string dump(const SceneDescription& scene, const Diagnostics& diagnostics);

}  // namespace nephroid::testing
