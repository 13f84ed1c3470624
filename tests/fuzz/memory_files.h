// Files in memory. The programs of this folder are linked with --wrap=fopen, so that the readers
// under test open these files and no others, whatever names the bytes contain.
#pragma once

#include <map>
#include <string>

namespace nephroid::fuzz {

/// While it lives, reads find these files (at least one) and no others. At most one at a time.
class MemoryFiles {
 public:
  explicit MemoryFiles(std::map<std::string, std::string> files);
  ~MemoryFiles();
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;
};

}  // namespace nephroid::fuzz
