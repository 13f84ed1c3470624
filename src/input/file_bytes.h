// Whole files as bytes, unpacked if their name ends in ".gz". It must not know what the bytes mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/errors.h"

namespace nephroid {

/// Maximum number of bytes that a packed file may unpack to.
inline constexpr uint64_t kMaxUnpackedBytes = uint64_t{8} << 30;

/// The bytes of a file. A name that ends in ".gz", and gzip data from a pipe, are unpacked to at
/// most `max_unpacked` bytes. Throws IoError with the file and the reason.
std::string read_file_bytes(const std::string& path, uint64_t max_unpacked = kMaxUnpackedBytes);

/// The bytes of standard input, unpacked if they are gzip data. Throws IoError.
std::string read_standard_input(uint64_t max_unpacked = kMaxUnpackedBytes);

/// True for pipes, terminals and other devices, which can be read only once and have no directory
/// of their own. False for missing files.
bool is_stream(const std::string& path);

/// Reports an unreadable file: throws a SceneError at the location that names the file, or an
/// IoError if no scene names it.
[[noreturn]] void file_is_unreadable(const SourceLocation& named_by, const std::string& message);

/// True if the name ends in `suffix`, ignoring case.
bool has_suffix(const std::string& path, const std::string& suffix);

}  // namespace nephroid
