// The Mitsuba importer on hostile text; see targets.h.
#include "fuzz/file_list.h"
#include "fuzz/memory_files.h"
#include "fuzz/targets.h"
#include "input/mitsuba/mitsuba_reader.h"

namespace nephroid::fuzz {

void mitsuba(const std::string& bytes) {
  const MemoryFiles files(files_of(bytes, "scene.xml"));
  Diagnostics diagnostics;
  try {
    read_mitsuba("scene.xml", {}, diagnostics);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
