// Files that exist in memory only. The programs of this folder are linked with --wrap=fopen, so
// that the readers under test open these files and no others, whatever names the bytes contain.
// Who calls it: the fuzz targets.
#pragma once

#include <map>
#include <string>

namespace nephroid::fuzz {

/// While it lives, reading finds these files (at least one) and nothing else. At most one at a
/// time.
class MemoryFiles {
 public:
  explicit MemoryFiles(std::map<std::string, std::string> files);
  ~MemoryFiles();
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;
};

}  // namespace nephroid::fuzz
