// Of what files a scene is, kept beside the results: a second invocation knows whether one of them
// has changed without loading the scene. Who calls it: bench.cpp. It must not know what they are.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "input/scene_files.h"

namespace nephroid {

class KeptScenes {
 public:
  /// Lists are in DIRECTORY/scenes.
  explicit KeptScenes(std::string directory) : directory_(std::move(directory)) {}

  /// SceneFiles::hash of the scene in `file`. `load` loads it and returns its files; it is called
  /// if no list is there or a file in it has changed. Asked for once, then remembered. Throws what
  /// `load` throws, and IoError if the scene cannot be read or the list not be written.
  uint64_t hash(const std::string& file, const std::function<const SceneFiles&()>& load);

 private:
  uint64_t find_hash(const std::string& file, const std::function<const SceneFiles&()>& load) const;

  std::string directory_;
  std::map<std::string, uint64_t> known_;  ///< by file
};

}  // namespace nephroid
