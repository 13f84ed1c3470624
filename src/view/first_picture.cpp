#include "view/first_picture.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

/// The page is as grey as this outside of the rendered part.
constexpr uint8_t kOutside = 9;

/// Pixels from `begin` to `end` of a picture's side that pixel `at` of the small one stands for.
struct Span {
  int begin, end;
};

Span span_of(int at, int small, int large) {
  const auto edge = [&](int i) { return static_cast<int>(int64_t{i} * large / small); };
  return {edge(at), std::max(edge(at) + 1, edge(at + 1))};
}

float value_at(const FrameLayer& layer, size_t index) {
  Imath::half half;
  half.setBits(layer.pixels[index]);
  return half * layer.scale;
}

/// Writes the mean of the finite pixels inside of the window to `out`, three bytes in sRGB.
void put_mean(const PictureFrame& frame, const Span& columns, const Span& rows, uint8_t* out) {
  const PixelBounds& window = frame.info.window;
  float sum[3] = {0, 0, 0};
  int count = 0;
  bool is_inside = false;
  for (int y = std::max(rows.begin, window.y0); y < std::min(rows.end, window.y1); ++y)
    for (int x = std::max(columns.begin, window.x0); x < std::min(columns.end, window.x1); ++x) {
      const size_t pixel =
          static_cast<size_t>(y - window.y0) * window.width() + static_cast<size_t>(x - window.x0);
      is_inside = true;
      float value[3];
      for (size_t c = 0; c < 3; ++c) value[c] = value_at(*frame.picture, 3 * pixel + c);
      if (!std::isfinite(value[0] + value[1] + value[2])) continue;
      for (int c = 0; c < 3; ++c) sum[c] += value[c];
      ++count;
    }
  for (int c = 0; c < 3; ++c)
    out[c] = is_inside ? encode_srgb8(sum[c] / static_cast<float>(std::max(count, 1))) : kOutside;
}

}  // namespace

std::vector<uint8_t> first_picture_png(const PictureFrame& frame) {
  const int longest = std::max(frame.info.width, frame.info.height);
  const double scale = std::min(1.0, 1.0 * kMaxFirstPictureEdge / longest);
  const int width = std::max(1, static_cast<int>(std::lround(frame.info.width * scale)));
  const int height = std::max(1, static_cast<int>(std::lround(frame.info.height * scale)));
  std::vector<uint8_t> rgb(static_cast<size_t>(width) * height * 3);
  uint8_t* out = rgb.data();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, out += 3)
      put_mean(frame, span_of(x, width, frame.info.width), span_of(y, height, frame.info.height),
               out);
  return encode_png(width, height, rgb);
}

}  // namespace nephroid
