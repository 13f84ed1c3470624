#include "view/first_reading.h"

#include "input/file_bytes.h"
#include "input/scene_reader.h"

namespace nephroid {

bool can_be_mended(const std::string& scene, ExitStatus failure) {
  if (failure != ExitStatus::kScene || is_stream(scene)) return false;
  // Files of any other name are read as pbrt, too.
  return !is_pbrt_scene(scene) || has_suffix(scene, ".pbrt") || has_suffix(scene, ".pbrt.gz");
}

}  // namespace nephroid
