// Parse, build, and keep what was suspicious.
#include "apps/scene_loading.h"

#include "apps/messages.h"
#include "input/pbrt_parser.h"

namespace nephroid {

LoadedScene load_scene(const std::string& file, const SceneOverrides& overrides) {
  LoadedScene loaded;
  Diagnostics diagnostics;
  loaded.description = parse_pbrt_file(file, diagnostics);
  loaded.scene = build_scene(loaded.description, overrides, diagnostics);
  for (const Warning& warning : diagnostics.warnings())
    loaded.warnings.push_back(located(warning.where, warning.message));
  return loaded;
}

void print_warnings(const LoadedScene& loaded) {
  for (const std::string& warning : loaded.warnings) print_warning(warning);
}

}  // namespace nephroid
