// Wavefront OBJ files with their MTL materials as scenes. Camera and lights are not part of them.
#pragma once

#include <string>

#include "input/import_options.h"
#include "input/scene_description.h"

namespace nephroid {

/// Reads an OBJ file and the MTL files that it names. Throws IoError if it cannot be read and
/// SceneError if its contents are wrong. A missing MTL file is a warning.
/// `files` become those of the scene; null: new ones.
SceneDescription read_obj_scene(const std::string& path, const ImportOptions& options,
                                Diagnostics& diagnostics,
                                std::shared_ptr<SceneFiles> files = nullptr);

}  // namespace nephroid
