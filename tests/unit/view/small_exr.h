// Small EXR files with the channels of a render, for views of pictures.
#pragma once

#include <string>
#include <vector>

#include "film/exr_file.h"
#include "film/film_output.h"

namespace nephroid::testing_support {

/// A picture of 3 x 2 pixels, the right lower part of 4 x 3. Channel c of pixel p has the value
/// c + p / 10.
inline Picture small_picture(const std::vector<std::string>& channels) {
  Picture picture;
  picture.full_width = 4;
  picture.full_height = 3;
  picture.window = {1, 1, 4, 3};
  picture.channels = channels;
  for (int p = 0; p < 6; ++p)
    for (size_t c = 0; c < channels.size(); ++c)
      picture.pixels.push_back(static_cast<float>(c) + static_cast<float>(p) / 10);
  return picture;
}

/// Writes it with all digits, and its PNG beside it.
inline void write_small_exr(const std::string& path, const Picture& picture) {
  write_picture(path, picture, 1, LayerPrecision::kFloat);
}

}  // namespace nephroid::testing_support
