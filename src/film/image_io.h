// Writes 8-bit PNG and reads pictures of any format by OpenImageIO; exr_file.h writes EXR. It must
// not know films, routes or scenes.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/color.h"
#include "film/film.h"

namespace nephroid {

/// Key and value, in the order in which they are written.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Value of the first entry with this key; empty if there is none.
std::string value_of(const Metadata& metadata, const std::string& key);

/// A picture without its pixels; `window` is their part of the full picture.
struct PictureHead {
  int full_width = 0, full_height = 0;
  PixelBounds window;
  std::vector<std::string> channels;
  /// Written as the file's chromaticities, unless null or sRGB.
  const RgbColorSpace* color_space = nullptr;
  Metadata metadata;

  int width() const { return window.width(); }
  int height() const { return window.height(); }
};

/// Named channels of floats, interleaved, rows from the top.
struct Picture : PictureHead {
  std::vector<float> pixels;
  /// Index of the channel with this exact name, -1 if there is none.
  int find_channel(const std::string& name) const;
};

/// Writes interleaved 8-bit sRGB, three bytes a pixel. Throws IoError; the old file then remains
/// (atomic_file.h).
void write_png(const std::string& path, int width, int height, const std::vector<uint8_t>& rgb);

/// The bytes of such a PNG file. Throws IoError.
std::vector<uint8_t> encode_png(int width, int height, const std::vector<uint8_t>& rgb);

/// Window, channels and metadata of the first image of a file of any format. Throws IoError.
PictureHead read_picture_head(const std::string& path);

/// Reads the first image of a file of any format as floats, with its string metadata and the
/// colour space of its chromaticities, into which nothing is converted. Colours stored as integers
/// (PNG, JPEG) are decoded from sRGB, so all are linear. Throws IoError.
Picture read_picture(const std::string& path);

/// A colour of the space `from` in the space `to`; null stands for sRGB.
Rgb converted(Rgb color, const RgbColorSpace* from, const RgbColorSpace* to);

/// Linear [0,1] to the sRGB code value, clamped and rounded; NaN becomes 0.
uint8_t encode_srgb8(float linear);

/// Limits the threads that compress and decompress images, to at most kMaxImageThreads. 0: one per
/// core.
void limit_image_threads(int threads);

}  // namespace nephroid
