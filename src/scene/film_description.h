// The Film directive, with the overrides of the command line.
#pragma once

#include "input/format_rows.h"
#include "scene/scene.h"

namespace nephroid {

/// All types of the format.
std::vector<FormatType> film_types();

/// Reads pbrt-v4's film parameters: resolution, crop, exposure, colour space, file name. Throws
/// SceneError.
FilmDescription make_film_description(const SceneDescription& description,
                                      const SceneOverrides& overrides, Diagnostics& diagnostics);

}  // namespace nephroid
