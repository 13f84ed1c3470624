// PixelPass: a small pass over one pixel, whose paths are recorded to explain the pixel. It must
// not know estimators.
#pragma once

#include "core/sampler.h"
#include "film/film_format.h"
#include "scene/scene.h"

namespace nephroid {

struct PixelPass {
  PassKey key;
  const Scene& scene;
  const FilmFormat& film;  ///< the format of the whole film
  int x = 0, y = 0;        ///< pixel of the crop
  int camera_paths = 64;
  int64_t light_paths = 1 << 13;  ///< limit of light paths
  uint32_t radius_pass = 0;       ///< pass of the film whose merge radius is used

  /// The film's format, cropped to the pixel.
  FilmFormat format_of_pixel() const {
    FilmSettings settings = film.settings();
    settings.crop = {x, y, x + 1, y + 1};
    return {settings, film.layout()};
  }
};

}  // namespace nephroid
