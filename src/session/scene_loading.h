// Loads a scene from its file, with its warnings and notes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "input/scene_description.h"
#include "scene/scene.h"

namespace nephroid {

struct LoadedScene {
  SceneDescription description;
  std::unique_ptr<Scene> scene;
  std::vector<std::string> warnings;       ///< "file:line:column: message"
  std::vector<std::string> notes;          ///< what is normal, in the same form
  std::vector<std::string> unknown_names;  ///< warnings about names that the format lacks
};

/// Throws SceneError and IoError. `files` as for read_scene().
LoadedScene load_scene(const std::string& file, const SceneOverrides& overrides,
                       std::shared_ptr<SceneFiles> files = nullptr);
/// The same with a picture whose longer side has at most `longest_side` pixels.
LoadedScene load_small_scene(const std::string& file, SceneOverrides overrides, int longest_side);

}  // namespace nephroid
