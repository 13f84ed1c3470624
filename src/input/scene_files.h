// The files of a scene: where the names in it lead, and what has been read, so that a picture can
// say of which scene it is.
// Who calls it: the parser, and whatever reads meshes, images, spectra, lenses, media. It must not
// know what is in the files.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace nephroid {

/// The name of a scene that is read from standard input; within scenes it is a name as any other.
inline constexpr const char* kStandardInput = "-";

/// May be asked from several threads.
class SceneFiles {
 public:
  /// Relative names are relative to `directory`.
  explicit SceneFiles(std::string directory = ".");

  const std::string& directory() const { return directory_; }
  /// The path that a name in the scene stands for.
  std::string path_of(const std::string& name) const;

  /// read_file_bytes, and what has been read counts in the hash.
  std::string read(const std::string& path);
  /// path_of a file that somebody else is about to read, an image for instance: it counts in the
  /// hash, if it can be read.
  std::string counted_path_of(const std::string& name);

  /// Of all that has been read: the files' contents and, but for the scene's own file, their names
  /// as seen from the directory, however they are written. The same wherever the directory is (if
  /// absolute names of files elsewhere do not occur), and in whatever order the files were read.
  uint64_t hash() const;
  /// Of all that has been read, the scene's own file apart: path_of finds them.
  std::vector<std::string> names() const;

  /// The scene's own file, whose name does not count.
  void set_top(const std::string& path) { top_ = path; }

 private:
  /// How a path is called in the hash.
  std::string counted_name(const std::string& path) const;

  std::string directory_, top_;
  mutable std::mutex mutex_;
  std::map<std::string, uint64_t> read_;  ///< hash of the content by counted_name
};

/// The directory that names in a scene are relative to: the scene's own, the current one for
/// standard input and pipes.
std::string directory_of_scene(const std::string& scene);

/// ContentHash of a file's bytes, of none for pipes and devices, which can be read only once or
/// never end. Throws IoError if it cannot be read.
uint64_t hash_file(const std::string& path);

}  // namespace nephroid
