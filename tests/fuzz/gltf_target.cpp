// The glTF reader on hostile files, and the view that such a scene gets; see targets.h.
#include "fuzz/memory_files.h"
#include "fuzz/mesh_check.h"
#include "fuzz/targets.h"
#include "input/scene_reader.h"

namespace nephroid::fuzz {

void gltf(const std::string& bytes) {
  const MemoryFiles files({{"scene.gltf", bytes}});
  ImportOptions options;
  options.time = 0.5;
  options.shutter = 0.25;
  options.floor = true;
  Diagnostics diagnostics;
  try {
    check_meshes(read_scene("scene.gltf", options, diagnostics));
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
