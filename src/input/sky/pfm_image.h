// An image as the bytes of a PFM file. It must not know what it shows.
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "core/color.h"

namespace nephroid {

/// `pixels` in rows from the top; rows of the file begin at the bottom.
inline std::string pfm_image(const std::vector<Rgb>& pixels, int width, int height) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  std::string bytes = "PF\n" + std::to_string(width) + " " + std::to_string(height) +
                      (std::endian::native == std::endian::little ? "\n-1.0\n" : "\n1.0\n");
  const size_t row = static_cast<size_t>(width) * sizeof(Rgb);
  for (int y = height - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(&pixels[static_cast<size_t>(y) * width]), row);
  return bytes;
}

}  // namespace nephroid
