// Files that are replaced as a whole: whoever reads the name sees the old content or the new one,
// never a part, whatever happens to this process or the machine in between.
// Who calls it: image_io.h and the session. It must not know what the bytes mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace nephroid {

/// A temporary file beside `path` that takes its place when it is whole. A symbolic link is
/// followed. All throw IoError with the system's reason; the temporary file vanishes with the
/// object unless it was committed, and an old file is then as it was.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// At so many bytes from its beginning.
  void write(uint64_t offset, std::span<const std::byte> bytes);
  /// Flushes it to the disk, renames it to `path` and flushes the directory.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The bytes as an AtomicFile.
void write_file_atomically(const std::string& path, std::span<const std::byte> bytes);

/// Throws the IoError that write_file_atomically(path) would throw now, as far as that can be known
/// without replacing the file: a directory in its place, a missing or unwritable directory. Removes
/// temporary files for it that processes of this machine have left when they were killed.
void check_file_can_be_written(const std::string& path);

}  // namespace nephroid
