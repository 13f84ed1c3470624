// The files beside a converted scene: it writes meshes and images in memory there, and finds the
// names by which the new scene reads the files of the old one. No other file is replaced: names
// that are taken by other bytes are passed over. It must not know directives.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "input/mesh_data.h"
#include "input/scene_description.h"

namespace nephroid {

class CompanionFiles {
 public:
  /// `scene_file` is the path of the converted scene.
  CompanionFiles(const SceneDescription& scene, const std::string& scene_file);

  /// Writes a mesh and returns its name for the converted scene. Throws IoError.
  std::string add_mesh(const MeshData& mesh);
  /// The name for the converted scene of a file that the old one names. Files in memory are
  /// written. Throws IoError.
  std::string name_of(const std::string& old_name);

  /// The names of the converted scene's own files, in the order of their numbers.
  const std::vector<std::string>& names() const { return names_; }

 private:
  /// Writes a file unless it is there already, and returns its name.
  std::string add(const std::string& bytes, const std::string& suffix);

  SceneFiles& files_;
  std::string directory_;  ///< directory of the converted scene
  std::string stem_;       ///< beginning of all names
  int last_number_ = 0;
  std::vector<std::string> names_;
  std::map<std::string, std::string> written_;  ///< names of files in memory
};

/// Writes a file. Throws IoError.
void write_bytes(const std::string& path, const std::string& bytes);

}  // namespace nephroid
