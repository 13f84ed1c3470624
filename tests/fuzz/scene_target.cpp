// The scene parser on hostile text; see targets.h.
#include "fuzz/file_list.h"
#include "fuzz/memory_files.h"
#include "fuzz/targets.h"
#include "input/pbrt_parser.h"

namespace nephroid::fuzz {

void scene(const std::string& bytes) {
  const MemoryFiles files(files_of(bytes, "scene.pbrt"));
  Diagnostics diagnostics;
  try {
    parse_pbrt_file("scene.pbrt", diagnostics);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
