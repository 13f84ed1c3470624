// Files that are replaced as a whole: a reader sees the old content or the new one, never a part,
// even if the process or the machine stops. It must not know what the bytes mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace nephroid {

/// A temporary file beside `path` that replaces it on commit(). Symbolic links are followed.
/// Without a commit the temporary file is removed and the old file is unchanged. All functions
/// throw IoError with the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Writes at `offset` bytes from the beginning.
  void write(uint64_t offset, std::span<const std::byte> bytes);
  /// Flushes it to the disk, renames it to `path` and flushes the directory.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes the bytes as an AtomicFile.
void write_file_atomically(const std::string& path, std::span<const std::byte> bytes);

/// Throws the IoError that write_file_atomically(path) would throw, as far as it is known without
/// replacing the file: the path is a directory, its directory is missing or not writable. Removes
/// temporary files for it that killed processes of this machine have left.
void check_file_can_be_written(const std::string& path);

}  // namespace nephroid
