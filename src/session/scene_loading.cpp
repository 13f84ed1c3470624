#include "session/scene_loading.h"

#include <algorithm>
#include <new>
#include <utility>

#include "input/scene_reader.h"
#include "scene/film_description.h"

namespace nephroid {

namespace {

LoadedScene build(SceneDescription description, const SceneOverrides& overrides,
                  Diagnostics& diagnostics) {
  LoadedScene loaded;
  loaded.description = std::move(description);
  loaded.scene = build_scene(loaded.description, overrides, diagnostics);
  for (const Warning& warning : diagnostics.warnings()) {
    loaded.warnings.push_back(located(warning.where, warning.message));
    if (warning.is_unknown_name) loaded.unknown_names.push_back(loaded.warnings.back());
  }
  for (const Warning& note : diagnostics.notes())
    loaded.notes.push_back(located(note.where, note.message));
  return loaded;
}

}  // namespace

LoadedScene load_scene(const std::string& file, const SceneOverrides& overrides,
                       std::shared_ptr<SceneFiles> files) {
  Diagnostics diagnostics;
  try {
    return build(read_scene(file, overrides.import, diagnostics, std::move(files)), overrides,
                 diagnostics);
  } catch (const std::bad_alloc&) {
    throw IoError(file + ": the scene does not fit into memory");
  }
}

LoadedScene load_small_scene(const std::string& file, SceneOverrides overrides, int longest_side) {
  Diagnostics diagnostics;
  SceneDescription description = read_scene(file, overrides.import, diagnostics);
  const FilmDescription film = make_film_description(description, overrides, diagnostics);
  const double scale =
      std::min(1.0, static_cast<double>(longest_side) / std::max(film.width, film.height));
  overrides.width = std::max(1, static_cast<int>(film.width * scale));
  overrides.height = std::max(1, static_cast<int>(film.height * scale));
  return build(std::move(description), overrides, diagnostics);
}

}  // namespace nephroid
