// Single layers of a film by name, for readers that do not want the whole picture of
// film_output.h. It must not know files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "film/film.h"

namespace nephroid {

/// A layer of a film: "picture" (all routes), a route, an AOV, "outliers", "albedo", "N", "Z",
/// "stderr", "bias" or "samples", with the meaning of film_output.h.
struct FilmLayer {
  std::string name;
  std::string channels;  ///< a letter for each channel: "RGB", "XYZ", "Z"
  /// Writes the channels of pixel x, y to `out`.
  std::function<void(const Film& film, int x, int y, float* out)> put;
};

/// All layers of a film.
std::vector<FilmLayer> film_layers(const Film& film);
/// Those of the film's layers that have one of the names, in the order of the names.
std::vector<FilmLayer> film_layers(const Film& film, const std::vector<std::string>& names);

/// The pixels of a layer, rows from the top, channels interleaved.
std::vector<float> layer_pixels(const Film& film, const FilmLayer& layer);

}  // namespace nephroid
