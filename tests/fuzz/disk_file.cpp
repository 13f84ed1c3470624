#include "fuzz/disk_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace nephroid::fuzz {

DiskFile::DiskFile(const std::string& bytes, const std::string& suffix) {
  namespace fs = std::filesystem;
  const fs::path directory = fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
  path_ = (directory / ("nephroid-fuzz-" + std::to_string(::getpid()) + suffix)).string();
  std::ofstream out(path_, std::ios::binary | std::ios::trunc);
  out << bytes;
  out.close();
  if (!out) throw std::runtime_error(path_ + ": cannot write");
}

DiskFile::~DiskFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

std::string image_suffix(const std::string& bytes) {
  for (const char* begin : {"\x76\x2f", "\x89P", "\xff\xd8", "#?", "P", "II", "MM", "BM"})
    if (bytes.starts_with(begin)) return ".image";
  return ".tga";
}

}  // namespace nephroid::fuzz
