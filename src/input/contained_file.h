// The rule for files that a foreign scene names: they lie in the folder of the scene, unless the
// user allows others. It must not know formats.
#pragma once

#include <string>

#include "core/errors.h"
#include "input/scene_files.h"

namespace nephroid {

/// Checks the name of a file, and returns it. After symbolic links the file must lie in the scene's
/// directory or below it. Throws SceneError at `named_by` if it does not and `allow_outside` is
/// false, and for a name with a zero byte.
std::string contained_file(const SceneFiles& files, const std::string& name, bool allow_outside,
                           const SourceLocation& named_by);

}  // namespace nephroid
