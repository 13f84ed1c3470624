// The scene parser on hostile text; see targets.h.
#include "fuzz/memory_files.h"
#include "fuzz/targets.h"
#include "input/pbrt_parser.h"

namespace nephroid::fuzz {
namespace {

constexpr std::string_view kMark = "#file ";

/// Splits the bytes at lines "#file NAME". The part before the first one is "scene.pbrt".
std::map<std::string, std::string> files_of(const std::string& bytes) {
  std::map<std::string, std::string> files;
  std::string* current = &files["scene.pbrt"];
  for (size_t start = 0; start < bytes.size();) {
    const size_t end = std::min(bytes.find('\n', start), bytes.size() - 1) + 1;
    const std::string line = bytes.substr(start, end - start);
    if (line.rfind(kMark, 0) == 0)
      current = &files[line.substr(kMark.size(), line.find_last_not_of("\r\n") + 1 - kMark.size())];
    else
      *current += line;
    start = end;
  }
  return files;
}

}  // namespace

void scene(const std::string& bytes) {
  const MemoryFiles files(files_of(bytes));
  Diagnostics diagnostics;
  try {
    parse_pbrt_file("scene.pbrt", diagnostics);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
