// Checks the size that an image file claims, before memory is allocated for it. It must not know
// formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

namespace nephroid {

/// False if `claimed` bytes of pixels cannot be in the file: no real image is compressed so well.
/// Small sizes are always possible, and so are any sizes of pipes and devices.
inline bool is_possible_size(uint64_t claimed, const std::string& path) {
  constexpr uint64_t kMaxBytesPerByte = 1 << 16;
  constexpr uint64_t kHarmless = uint64_t{64} << 20;
  if (claimed <= kHarmless) return true;
  std::error_code error;
  const uint64_t there = std::filesystem::file_size(path, error);
  return error || claimed / kMaxBytesPerByte <= there;
}

}  // namespace nephroid
