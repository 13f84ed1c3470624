// Checks the size that an image file claims, before memory is allocated for it. It must not know
// formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

namespace nephroid {

/// False if `claimed` bytes of pixels cannot be in a file of so many bytes: no real image is
/// compressed so well. Small sizes are always possible.
inline bool is_possible_size(uint64_t claimed, uint64_t file_bytes) {
  constexpr uint64_t kMaxBytesPerByte = 1 << 16;
  constexpr uint64_t kHarmless = uint64_t{64} << 20;
  return claimed <= kHarmless || claimed / kMaxBytesPerByte <= file_bytes;
}

/// The same for the file of that name. Any sizes of pipes and devices are possible.
inline bool is_possible_size(uint64_t claimed, const std::string& path) {
  std::error_code error;
  const uint64_t there = std::filesystem::file_size(path, error);
  return error || is_possible_size(claimed, there);
}

}  // namespace nephroid
