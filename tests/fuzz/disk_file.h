// A file on disk for readers of other libraries, which open it themselves.
#pragma once

#include <string>

namespace nephroid::fuzz {

/// Deletes its file on destruction. It is in memory (/dev/shm) where possible. At most one file per
/// suffix and process at a time.
class DiskFile {
 public:
  DiskFile(const std::string& bytes, const std::string& suffix);
  ~DiskFile();
  DiskFile(const DiskFile&) = delete;
  DiskFile& operator=(const DiskFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// ".tga" if the bytes match no other image format, else ".image".
std::string image_suffix(const std::string& bytes);

}  // namespace nephroid::fuzz
