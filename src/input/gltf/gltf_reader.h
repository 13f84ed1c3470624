// Reads glTF 2.0 files, .gltf and .glb, into a SceneDescription.
#pragma once

#include <string>

#include "input/import_options.h"
#include "input/scene_description.h"

namespace nephroid {

/// Throws IoError if the file cannot be read, and SceneError with the file and a JSON pointer if
/// its contents are wrong. `files` become those of the scene; null: new ones.
SceneDescription read_gltf(const std::string& path, const ImportOptions& options,
                           Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files = nullptr);

}  // namespace nephroid
