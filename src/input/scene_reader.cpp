#include "input/scene_reader.h"

#include <algorithm>
#include <utility>

#include "input/file_bytes.h"
#include "input/gltf/gltf_reader.h"
#include "input/missing_images.h"
#include "input/mitsuba/mitsuba_reader.h"
#include "input/obj/obj_scene.h"
#include "input/pbrt_parser.h"
#include "input/spelling.h"
#include "input/staging/staging.h"

namespace nephroid {
namespace {

struct SceneFormat {
  const char* suffix;  ///< end of the file's name, in lower case
  SceneDescription (*read)(const std::string& path, const ImportOptions& options,
                           Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files);
  FormatTraits traits;
};

SceneDescription read_pbrt(const std::string& path, const ImportOptions&, Diagnostics& diagnostics,
                           std::shared_ptr<SceneFiles> files) {
  return parse_pbrt_file(path, diagnostics, std::move(files));
}

/// Surfaces of glTF that emit up to 1, more than which needs an extension, are displays and the
/// like.
constexpr FormatTraits kGltf = {.glow = 1};

/// One row per suffix. The last row takes every other name.
constexpr SceneFormat kFormats[] = {
    {".obj", read_obj_scene, {}},
    {".obj.gz", read_obj_scene, {}},
    {".gltf", read_gltf, kGltf},
    {".glb", read_gltf, kGltf},
    {".xml", read_mitsuba, {.has_exposure = true}},
    {"", read_pbrt, {.is_complete = true, .has_exposure = true}},
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

/// Warns of choices of the user among things that the file does not have. Formats that have them
/// refuse unknown names.
void warn_of_missing_choices(const SceneDescription& scene, const ImportOptions& options,
                             Diagnostics& diagnostics) {
  const auto warn = [&](const std::string& option, const char* things) {
    diagnostics.warn({std::make_shared<const std::string>(scene.file), 0, 0},
                     option + " is ignored: the file has no " + things);
  };
  const FileChoices& choices = scene.choices;
  if (!options.camera.empty() && choices.cameras.empty()) warn("--camera", "list of cameras");
  if (!options.variant.empty() && choices.variants.empty()) warn("--variant", "material variants");
  if (choices.animations.empty() && options.time != 0) warn("--at", "animations");
  if (choices.animations.empty() && options.shutter != 0) warn("--shutter", "animations");
}

const SceneFormat& format_of(const std::string& path) {
  const std::string name = lower_case(path);
  return *std::find_if(std::begin(kFormats), std::end(kFormats),
                       [&](const SceneFormat& row) { return has_suffix(name, row.suffix); });
}

}  // namespace

bool is_pbrt_scene(const std::string& path) {
  return format_of(path).read == read_pbrt;
}

SceneDescription read_scene(const std::string& path, const ImportOptions& options,
                            Diagnostics& diagnostics, std::shared_ptr<SceneFiles> files) {
  const SceneFormat& format = format_of(path);
  warn_of_foreign_options(format, path, options, diagnostics);
  SceneDescription scene = format.read(path, options, diagnostics, std::move(files));
  warn_of_missing_choices(scene, options, diagnostics);
  if (!format.traits.is_complete) refuse_missing_images(scene);
  stage_scene(&scene, format.traits, options, diagnostics);
  return scene;
}

}  // namespace nephroid
