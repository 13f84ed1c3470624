// An image for lookups: linear values of 1 to 4 channels, stored as bytes with a table, as half
// or float numbers, or fetched on demand. Row 0 is the top row. It must not know files or scenes.
#pragma once

#include <half.h>

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "core/color.h"
#include "core/math.h"

namespace nephroid {

/// Lookups outside of the image. kOctahedralSphere continues an equal-area octahedral map across
/// the edges of its sphere.
enum class WrapMode { kRepeat, kMirror, kBlack, kClamp, kOctahedralSphere };
/// Parses "repeat", "mirror", "black", "clamp" or "octahedralsphere". Empty for anything else.
std::optional<WrapMode> parse_wrap_mode(std::string_view name);

/// The modes of both axes. kOctahedralSphere is one of both together.
struct WrapModes {
  WrapMode u, v;
  WrapModes(WrapMode both) : u(both), v(both) {}  // NOLINT: one mode is that of both axes
  WrapModes(WrapMode along_u, WrapMode along_v) : u(along_u), v(along_v) {}
};

/// Pixels that are not in memory. Safe to use from any number of threads.
class PixelSource {
 public:
  virtual ~PixelSource() = default;
  /// The linear values of a block of up to four pixels inside the image: all channels of a pixel,
  /// pixel by pixel, row by row.
  virtual void fetch(int x, int y, int width, int height, float* values) const = 0;
};

class Image {
 public:
  struct Bytes {
    std::vector<uint8_t> values;
    std::array<float, 256> table;  ///< linear value of a byte
  };
  using Halves = std::vector<Imath::half>;
  using Floats = std::vector<float>;
  using Source = std::shared_ptr<const PixelSource>;
  using Pixels = std::variant<Bytes, Halves, Floats, Source>;

  /// `pixels` holds, or fetches, width * height * channels values, row by row from the top,
  /// channels interleaved. `channels` is 1 (grey), 2 (grey and alpha), 3 (rgb) or 4 (rgb and
  /// alpha); alpha is not 1 everywhere.
  Image(int width, int height, int channels, Pixels pixels, const RgbColorSpace& space);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  const RgbColorSpace& color_space() const { return *space_; }
  /// Bytes that the pixels occupy in memory: 0 if they are fetched.
  size_t memory() const;
  /// The largest magnitude of all values; infinite if one is infinite or NaN.
  float largest_value() const;

  /// Linear value of one channel of a pixel inside the image.
  float value(int x, int y, int channel) const;
  /// Colour of a pixel, which can lie outside; three equal values for grey images.
  Rgb texel(int x, int y, WrapModes wrap) const;
  /// Colour of the pixel that contains `st`. (0,0) is the upper left corner of the image, (1,1) the
  /// lower right one.
  Rgb nearest(const Vec2f& st, WrapModes wrap) const;
  /// Colour interpolated between the centres of the four nearest pixels.
  Rgb bilinear(const Vec2f& st, WrapModes wrap) const;

  /// The same as one number. The nearest pixel gives its first channel (like pbrt-v4's filter
  /// "point"). The bilinear lookup gives grey, else alpha if there is one, else the mean of r, g,
  /// b.
  float nearest_float(const Vec2f& st, WrapModes wrap) const;
  float bilinear_float(const Vec2f& st, WrapModes wrap) const;

  /// One channel: 0 to 2 are red, green and blue, which are equal in grey images, and 3 is alpha,
  /// which is 1 where there is none.
  float nearest_channel(const Vec2f& st, WrapModes wrap, int channel) const;
  float bilinear_channel(const Vec2f& st, WrapModes wrap, int channel) const;

 private:
  bool has_alpha() const { return channels_ % 2 == 0; }
  /// Where the channel of a lookup is stored; alpha only if there is one.
  int stored_channel(int channel) const {
    if (channel == 3) return channels_ - 1;
    return channels_ < 3 ? 0 : channel;
  }

  int width_, height_, channels_;
  Pixels pixels_;
  const RgbColorSpace* space_;
};

}  // namespace nephroid
