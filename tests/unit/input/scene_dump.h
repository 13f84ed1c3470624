// A SceneDescription as text, one fact a line, for comparison with the files in golden/.
// Used by the tests of this folder only.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid::testing {

/// Everything that the description holds, then the warnings. Places are without their directory.
std::string dump(const SceneDescription& scene, const Diagnostics& diagnostics);

}  // namespace nephroid::testing
