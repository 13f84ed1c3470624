// Whole files as bytes, unpacked if their name ends in ".gz".
// Called by the scene parser and by the mesh and data readers of this layer.
// Knows nothing of what the bytes mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/errors.h"

namespace nephroid {

/// The most bytes that a packed file may unpack to.
inline constexpr uint64_t kMaxUnpackedBytes = uint64_t{8} << 30;

/// The bytes of a file; a name that ends in ".gz" is unpacked, to at most `max_unpacked` bytes, and
/// so is gzip data from a pipe.
/// Throws IoError naming the file and the reason.
std::string read_file_bytes(const std::string& path, uint64_t max_unpacked = kMaxUnpackedBytes);

/// The bytes of standard input, unpacked if they are gzip data. Throws IoError.
std::string read_standard_input(uint64_t max_unpacked = kMaxUnpackedBytes);

/// True for pipes, terminals and other devices, which can be read only once and stand in no
/// directory of their own; false for what is not there.
bool is_stream(const std::string& path);

/// Says that a file cannot be read: throws a SceneError at the place that names the file, or an
/// IoError if no scene does.
[[noreturn]] void file_is_unreadable(const SourceLocation& named_by, const std::string& message);

/// True if the name ends in `suffix`, whatever the case of its letters.
bool has_suffix(const std::string& path, const std::string& suffix);

}  // namespace nephroid
