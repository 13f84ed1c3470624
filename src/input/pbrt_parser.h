// Reads pbrt-v4 scene files into a SceneDescription.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid {

/// Parses the file (".gz" is unpacked) and all it includes or imports. Throws IoError if a file
/// cannot be read and SceneError for anything that is not pbrt-v4. Warnings go to `diagnostics`.
/// `files` become those of the scene; null: new ones.
SceneDescription parse_pbrt_file(const std::string& path, Diagnostics& diagnostics,
                                 std::shared_ptr<SceneFiles> files = nullptr);

/// The same for text in memory. `name` is its name in messages; file names are relative to
/// `directory`.
SceneDescription parse_pbrt_string(const std::string& text, const std::string& name,
                                   const std::string& directory, Diagnostics& diagnostics);

}  // namespace nephroid
