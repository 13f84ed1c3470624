// Field by field.
#include "session/film_of_scene.h"

#include <filesystem>

namespace nephroid {

FilmSettings film_settings(const FilmDescription& description) {
  FilmSettings settings;
  settings.width = description.width;
  settings.height = description.height;
  settings.crop = {description.crop_x0, description.crop_y0, description.crop_x1,
                   description.crop_y1};
  settings.imaging_ratio = description.imaging_ratio;
  settings.max_component = description.max_component;
  settings.color_space = description.color_space;
  settings.filename = description.filename;
  return settings;
}

std::string default_output(const FilmDescription& film, const std::string& scene_file) {
  std::filesystem::path stem = std::filesystem::path(film.filename).stem();
  if (stem.empty()) {
    stem = std::filesystem::path(scene_file).filename();
    if (stem.extension() == ".gz") stem = stem.stem();
    stem = stem.stem();
  }
  return stem.string() + ".exr";
}

}  // namespace nephroid
