// Fowler, Noll and Vo's hash, byte by byte.
#include "session/file_hash.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "core/errors.h"

namespace nephroid {

uint64_t hash_file(const std::string& path) {
  uint64_t hash = 0xcbf29ce484222325ull;
  std::error_code ignored;
  if (std::filesystem::is_fifo(path, ignored)) return hash;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path + ": cannot read: " + std::strerror(errno));
  std::vector<char> block(1 << 16);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    for (std::streamsize i = 0; i < file.gcount(); ++i) {
      hash ^= static_cast<unsigned char>(block[static_cast<size_t>(i)]);
      hash *= 0x100000001b3ull;
    }
  }
  if (file.bad()) throw IoError(path + ": cannot read: " + std::strerror(errno));
  return hash;
}

}  // namespace nephroid
