// Lists of the files of scenes, kept beside the results: a later invocation finds changed files
// without loading the scene. It must not know the contents of the files.
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
  /// The lists are in DIRECTORY/scenes.
  explicit KeptScenes(std::string directory) : directory_(std::move(directory)) {}

  /// SceneFiles::hash of the scene in `file`, cached. `load` loads the scene and returns its files;
  /// it is called if there is no list or a listed file has changed. Throws the errors of `load`,
  /// and IoError if the scene cannot be read or the list cannot be written.
  uint64_t hash(const std::string& file, const std::function<const SceneFiles&()>& load);

 private:
  uint64_t find_hash(const std::string& file, const std::function<const SceneFiles&()>& load) const;

  std::string directory_;
  std::map<std::string, uint64_t> known_;  ///< hash by file
};

}  // namespace nephroid
