// A file on the disk for readers that open it themselves, in other libraries.
// Who calls it: the fuzz targets.
#pragma once

#include <string>

namespace nephroid::fuzz {

/// There while it lives; in memory (/dev/shm) where the machine has that. At most one of each
/// suffix at a time in a process.
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

/// ".tga" if the bytes begin as no other image does, else ".image".
std::string image_suffix(const std::string& bytes);

}  // namespace nephroid::fuzz
