// Reads scenes of Mitsuba 0.5, 0.6, 2 and 3. It must not know XML or plug-ins.
#pragma once

#include <string>

#include "input/import_options.h"
#include "input/scene_description.h"

namespace nephroid {

/// The camera is `options.camera`, by id or index, else the first. Throws IoError if the scene
/// cannot be read and SceneError if its contents are wrong. `files` become those of the scene;
/// null: new ones.
SceneDescription read_mitsuba(const std::string& path, const ImportOptions& options,
                              Diagnostics& diagnostics,
                              std::shared_ptr<SceneFiles> files = nullptr);

}  // namespace nephroid
