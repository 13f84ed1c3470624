// Reads a scene file of any format into a SceneDescription. It must not know the contents of
// formats.
#pragma once

#include <memory>
#include <string>

#include "input/import_options.h"
#include "input/scene_description.h"

namespace nephroid {

/// The reader is chosen by the end of the name; without a known one the file is pbrt-v4. Throws
/// IoError if a file cannot be read and SceneError if its contents are wrong. `files` become those
/// of the scene, so a caller knows what was read when it throws; null: new ones.
SceneDescription read_scene(const std::string& path, const ImportOptions& options,
                            Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files = nullptr);

/// True if read_scene reads a file of that name as pbrt.
bool is_pbrt_scene(const std::string& path);

}  // namespace nephroid
