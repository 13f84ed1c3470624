// Files that are replaced as a whole: whoever reads the name sees the old content or the new one,
// never a part, whatever happens to this process or the machine in between.
// Who calls it: image_io.h and the session. It must not know what the bytes mean.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace nephroid {

/// Writes the bytes to a temporary file in the same directory, flushes it to the disk, renames it
/// to `path` and flushes the directory. A symbolic link is followed. Throws IoError with the
/// system's reason; the temporary file is then gone and an old file is as it was.
void write_file_atomically(const std::string& path, std::span<const std::byte> bytes);

/// Throws the IoError that write_file_atomically(path) would throw now, as far as that can be known
/// without replacing the file: a directory in its place, a missing or unwritable directory.
void check_file_can_be_written(const std::string& path);

}  // namespace nephroid
