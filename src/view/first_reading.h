// Whether a view may wait for a scene that could not be read. It must not know how scenes are read.
#pragma once

#include <string>

#include "core/errors.h"

namespace nephroid {

/// True if the scene is a file that an editor can mend while the view watches it: it is named as
/// scenes are, and its text is wrong. A missing file, or one of another kind, is a wrong command.
bool can_be_mended(const std::string& scene, ExitStatus failure);

}  // namespace nephroid
