// The Mitsuba importer on hostile text, and the view that such a scene gets; see targets.h.
#include "fuzz/file_list.h"
#include "fuzz/memory_files.h"
#include "fuzz/mesh_check.h"
#include "fuzz/targets.h"
#include "input/scene_reader.h"

namespace nephroid::fuzz {

void mitsuba(const std::string& bytes) {
  const MemoryFiles files(files_of(bytes, "scene.xml"));
  Diagnostics diagnostics;
  try {
    check_meshes(read_scene("scene.xml", {}, diagnostics));
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
