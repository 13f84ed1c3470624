// The files of a scene: resolves names, hashes the files that were read, as the identity of the
// scene, and notes which files were wanted. It must not know the contents of files.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "input/file_stamp.h"

namespace nephroid {

/// The name of a scene that is read from standard input; within scenes it is an ordinary name.
inline constexpr const char* kStandardInput = "-";

/// A file to read: on disk, or in memory if there are bytes.
struct FileSource {
  std::string path;                          ///< name in messages, and of a file on disk
  std::shared_ptr<const std::string> bytes;  ///< contents of a file in memory; null on disk

  FileSource(std::string file) : path(std::move(file)) {}  // NOLINT: a path is a source
  FileSource(std::string name, std::shared_ptr<const std::string> contents)
      : path(std::move(name)), bytes(std::move(contents)) {}
};

/// Thread-safe.
class SceneFiles {
 public:
  /// Relative names are relative to `directory`.
  explicit SceneFiles(std::string directory = ".");

  const std::string& directory() const { return directory_; }
  /// The path of a name in the scene.
  std::string path_of(const std::string& name) const;

  /// read_file_bytes; the file counts in the hash.
  std::string read(const std::string& path);
  /// path_of a file that is read elsewhere, such as an image. It counts in the hash if it can be
  /// read.
  std::string counted_path_of(const std::string& name);
  /// The same for a name that may be that of a file in memory.
  FileSource source_of(const std::string& name);

  /// Adds a file that is a part of another one, such as an image in a GLB file. It does not count
  /// in the hash by itself: the file that contains it does.
  void add_in_memory(const std::string& name, std::string bytes);
  /// The contents of such a file; null if there is none of that name.
  std::shared_ptr<const std::string> in_memory(const std::string& name) const;

  /// Hash of all files that were read: their contents and, except for the scene's own file, their
  /// names relative to the directory. It depends neither on the order of reading nor on the
  /// location of the directory, unless absolute names of files elsewhere occur.
  uint64_t hash() const;
  /// Names of all files that were read, without the scene's own; arguments for path_of.
  std::vector<std::string> names() const;

  /// The files that were read or looked for, by path, as they were just before. Standard input,
  /// pipes, and files in memory are left out.
  FileStamps stamps() const;

  /// Sets the scene's own file, whose name does not count in the hash.
  void set_top(const std::string& path) { top_ = path; }

 private:
  /// The name of a path in the hash.
  std::string counted_name(const std::string& path) const;
  /// Keeps the stamp of a file that is about to be read for the first time.
  void note(const std::string& path);

  std::string directory_, top_;
  mutable std::mutex mutex_;
  std::map<std::string, uint64_t> read_;  ///< hash of the content by counted_name
  FileStamps stamps_;
  std::map<std::string, std::shared_ptr<const std::string>> in_memory_;  ///< by name
};

/// The base directory of names in a scene: the scene's own, or the current one for standard input
/// and pipes.
std::string directory_of_scene(const std::string& scene);

/// The files of a scene that is still to be read.
std::shared_ptr<SceneFiles> files_of_scene(const std::string& scene);

/// ContentHash of a file's bytes. Pipes and devices are not read, since they can be read only once
/// or never end: they hash as empty. Throws IoError if the file cannot be read.
uint64_t hash_file(const std::string& path);

}  // namespace nephroid
