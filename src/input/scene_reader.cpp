#include "input/scene_reader.h"

#include <algorithm>
#include <cctype>

#include "input/file_bytes.h"
#include "input/gltf/gltf_reader.h"
#include "input/mitsuba/mitsuba_reader.h"
#include "input/obj/obj_scene.h"
#include "input/pbrt_parser.h"
#include "input/staging/staging.h"

namespace nephroid {
namespace {

struct SceneFormat {
  const char* suffix;  ///< end of the file's name, in lower case
  SceneDescription (*read)(const std::string& path, const ImportOptions& options,
                           Diagnostics& diagnostics);
  bool is_complete = false;  ///< a scene without camera or light is meant to be so
};

SceneDescription read_pbrt(const std::string& path, const ImportOptions&,
                           Diagnostics& diagnostics) {
  return parse_pbrt_file(path, diagnostics);
}

/// One row per suffix. The last row takes every other name.
constexpr SceneFormat kFormats[] = {
    {".obj", read_obj_scene}, {".obj.gz", read_obj_scene}, {".gltf", read_gltf},
    {".glb", read_gltf},      {".xml", read_mitsuba},      {"", read_pbrt, true},
};

/// Warns of options that only other formats know.
void warn_of_foreign_options(const SceneFormat& format, const std::string& path,
                             const ImportOptions& options, Diagnostics& diagnostics) {
  const auto warn = [&](const std::string& option, const char* formats) {
    diagnostics.warn({std::make_shared<const std::string>(path), 0, 0},
                     option + " is ignored: only " + formats + " files have it");
  };
  if (!options.defines.empty() && format.read != read_mitsuba) warn("--define", "Mitsuba");
  if (options.solid_glass && format.read != read_gltf && format.read != read_obj_scene)
    warn("--solid-glass", "glTF and OBJ");
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

SceneDescription read_scene(const std::string& path, const ImportOptions& options,
                            Diagnostics& diagnostics) {
  const std::string name = lower_case(path);
  const SceneFormat* format =
      std::find_if(std::begin(kFormats), std::end(kFormats),
                   [&](const SceneFormat& row) { return has_suffix(name, row.suffix); });
  warn_of_foreign_options(*format, path, options, diagnostics);
  SceneDescription scene = format->read(path, options, diagnostics);
  stage_scene(&scene, format->is_complete, options, diagnostics);
  return scene;
}

}  // namespace nephroid
