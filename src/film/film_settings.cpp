#include "film/film_settings.h"

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
  settings.diagonal_mm = description.diagonal_mm;
  settings.white_balance = description.white_balance;
  settings.gbuffer = description.gbuffer != GBufferSpace::kNone;
  return settings;
}

}  // namespace nephroid
