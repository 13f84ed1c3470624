// Writes a scene description as a pbrt-v4 scene with its meshes and images beside it. It must not
// know the meaning of types, but for the names of parameters that are files.
#pragma once

#include <string>

#include "input/scene_description.h"

namespace nephroid {

/// Writes the scene to `path`. Reading it gives a description of the same scene:
/// - materials without a name get the one by which light path expressions know them;
/// - triangle meshes of more than a few faces and images in memory become files beside the scene;
/// - names of other files are relative to the new scene.
/// Comments say what of the scene is not pbrt-v4's. Returns the names of the files beside it.
/// Throws IoError if a file cannot be written.
std::vector<std::string> write_pbrt(const SceneDescription& scene, const std::string& path);

}  // namespace nephroid
