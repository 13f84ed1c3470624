// Replaces fopen in the programs of this folder; see memory_files.h.
#include "fuzz/memory_files.h"

#include <cerrno>
#include <cstdio>

namespace nephroid::fuzz {
namespace {

std::map<std::string, std::string>& files_in_memory() {
  static std::map<std::string, std::string> files;
  return files;
}

}  // namespace

MemoryFiles::MemoryFiles(std::map<std::string, std::string> files) {
  files_in_memory() = std::move(files);
}

MemoryFiles::~MemoryFiles() {
  files_in_memory().clear();
}

}  // namespace nephroid::fuzz

extern "C" std::FILE* __real_fopen(const char* path, const char* mode);

extern "C" std::FILE* __wrap_fopen(const char* path, const char* mode) {
  auto& files = nephroid::fuzz::files_in_memory();
  // libFuzzer writes files of its own; the readers under test only read.
  if (files.empty() || mode[0] == 'w') return __real_fopen(path, mode);
  const auto found = files.find(path);
  if (found == files.end()) {
    errno = ENOENT;
    return nullptr;
  }
  return fmemopen(found->second.data(), found->second.size(), "rb");
}
