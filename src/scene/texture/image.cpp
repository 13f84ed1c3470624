// Lookups in images: wrapping of pixel coordinates, nearest and bilinear values; see image.h.
#include "scene/texture/image.h"

#include <algorithm>

namespace nephroid {

namespace {

template <class Integer>
Integer modulo(int a, Integer b) {
  const Integer r = a % b;
  return r < 0 ? r + b : r;
}

/// The position without whole periods of its wrap mode, so that weights keep precision far from the
/// origin.
float within_period(float x, WrapMode wrap) {
  if (wrap == WrapMode::kRepeat) return x - std::floor(x);
  if (wrap == WrapMode::kMirror) return x - 2.0f * std::floor(0.5f * x);
  return x;
}

/// Wraps a pixel coordinate into 0 to size - 1. False if it lies in a black surround.
bool wrap_axis(int& x, int size, WrapMode wrap) {
  if (x >= 0 && x < size) return true;
  switch (wrap) {
    case WrapMode::kRepeat:
      x = modulo(x, size);
      return true;
    case WrapMode::kMirror: {
      const int folded = static_cast<int>(modulo(x, 2 * int64_t{size}));
      x = folded < size ? folded : 2 * size - 1 - folded;
      return true;
    }
    case WrapMode::kBlack:
      return false;
    default:
      x = std::clamp(x, 0, size - 1);
      return true;
  }
}

/// Beyond an edge the sphere continues at the point mirrored about the middle of that edge.
void wrap_octahedron(int& x, int& y, int width, int height) {
  if (x < 0 || x >= width) {
    x = std::clamp(x < 0 ? -1 - x : 2 * width - 1 - x, 0, width - 1);
    y = height - 1 - y;
  }
  if (y < 0 || y >= height) {
    x = width - 1 - x;
    y = std::clamp(y < 0 ? -1 - y : 2 * height - 1 - y, 0, height - 1);
  }
}

/// Wraps a pixel into the image. False if it lies in a black surround.
bool wrap_pixel(int& x, int& y, int width, int height, WrapModes wrap) {
  if (x >= 0 && x < width && y >= 0 && y < height) return true;
  if (wrap.u != WrapMode::kOctahedralSphere)
    return wrap_axis(x, width, wrap.u) && wrap_axis(y, height, wrap.v);
  wrap_octahedron(x, y, width, height);
  return true;
}

/// Pixel coordinate of a position; positions far outside stay representable.
int floor_to_int(float v) {
  return static_cast<int>(std::floor(std::clamp(v, -1e9f, 1e9f)));
}

float decode(const Image::Bytes& b, size_t i) {
  return b.table[b.values[i]];
}
float decode(const Image::Halves& h, size_t i) {
  return h[i];
}
float decode(const Image::Floats& f, size_t i) {
  return f[i];
}

/// The four pixels around a position with their weights; weight 0 for those in a black surround.
struct Footprint {
  std::array<size_t, 4> pixel{};
  std::array<float, 4> weight{};
};
Footprint bilinear_footprint(const Vec2f& st, int width, int height, WrapModes wrap) {
  const Vec2f p(within_period(st.x, wrap.u), within_period(st.y, wrap.v));
  const float x = p.x * static_cast<float>(width) - 0.5f;
  const float y = p.y * static_cast<float>(height) - 0.5f;
  const int x0 = floor_to_int(x), y0 = floor_to_int(y);
  const float dx = std::clamp(x - static_cast<float>(x0), 0.0f, 1.0f);
  const float dy = std::clamp(y - static_cast<float>(y0), 0.0f, 1.0f);
  const float weights[4] = {(1 - dx) * (1 - dy), dx * (1 - dy), (1 - dx) * dy, dx * dy};
  Footprint f;
  for (int i = 0; i < 4; ++i) {
    int xi = x0 + (i & 1), yi = y0 + (i >> 1);
    if (!wrap_pixel(xi, yi, width, height, wrap)) continue;
    f.pixel[i] = static_cast<size_t>(yi) * width + xi;
    f.weight[i] = weights[i];
  }
  return f;
}

/// The fetched pixels of a footprint.
struct Fetched {
  std::array<float, 16> values;
};
float decode(const Fetched& f, size_t i) {
  return f.values[i];
}

template <class Values>
float weighted(const Values& values, const Footprint& f, int channels, int channel) {
  float sum = 0.0f;
  for (int i = 0; i < 4; ++i)
    if (f.weight[i] != 0.0f) sum += f.weight[i] * decode(values, f.pixel[i] * channels + channel);
  return sum;
}

/// Fetches the pixels of a footprint, in one call if they form a block, and renumbers them.
Fetched fetch(const PixelSource& source, Footprint& f, int width, int channels) {
  Fetched fetched;
  const auto x = [&](size_t i) { return static_cast<int>(f.pixel[i] % width); };
  const auto y = [&](size_t i) { return static_cast<int>(f.pixel[i] / width); };
  const bool is_block = f.pixel[1] == f.pixel[0] + 1 && x(1) != 0 &&
                        f.pixel[2] == f.pixel[0] + width && f.pixel[3] == f.pixel[2] + 1;
  if (is_block) source.fetch(x(0), y(0), 2, 2, fetched.values.data());
  for (size_t i = 0; i < 4; ++i) {
    if (!is_block && f.weight[i] != 0.0f)
      source.fetch(x(i), y(i), 1, 1, &fetched.values[i * channels]);
    f.pixel[i] = i;
  }
  return fetched;
}

/// Calls compute(values) with the array that the footprint's pixel numbers index.
template <class Compute>
auto with_values(const Image::Pixels& pixels, Footprint& f, int width, int channels,
                 const Compute& compute) {
  if (const auto* bytes = std::get_if<Image::Bytes>(&pixels)) return compute(*bytes);
  if (const auto* halves = std::get_if<Image::Halves>(&pixels)) return compute(*halves);
  if (const auto* floats = std::get_if<Image::Floats>(&pixels)) return compute(*floats);
  return compute(fetch(*std::get<Image::Source>(pixels), f, width, channels));
}

}  // namespace

std::optional<WrapMode> parse_wrap_mode(std::string_view name) {
  if (name == "repeat") return WrapMode::kRepeat;
  if (name == "mirror") return WrapMode::kMirror;
  if (name == "black") return WrapMode::kBlack;
  if (name == "clamp") return WrapMode::kClamp;
  if (name == "octahedralsphere") return WrapMode::kOctahedralSphere;
  return std::nullopt;
}

Image::Image(int width, int height, int channels, Pixels pixels, const RgbColorSpace& space)
    : width_(width),
      height_(height),
      channels_(channels),
      pixels_(std::move(pixels)),
      space_(&space) {}

size_t Image::memory() const {
  constexpr size_t kBytes[] = {1, 2, 4, 0};  // bytes per value, in the order of the variant
  return static_cast<size_t>(width_) * height_ * channels_ * kBytes[pixels_.index()];
}

float Image::largest_value() const {
  float largest = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < channels_; ++c) {
        const float v = std::abs(value(x, y, c));
        if (!std::isfinite(v)) return kInfinity;
        largest = std::max(largest, v);
      }
  return largest;
}

float Image::value(int x, int y, int channel) const {
  Footprint f;
  f.pixel[0] = static_cast<size_t>(y) * width_ + x;
  f.weight[0] = 1.0f;
  return with_values(pixels_, f, width_, channels_, [&](const auto& values) {
    return decode(values, f.pixel[0] * channels_ + channel);
  });
}

Rgb Image::texel(int x, int y, WrapModes wrap) const {
  if (!wrap_pixel(x, y, width_, height_, wrap)) return {};
  if (channels_ >= 3) return {value(x, y, 0), value(x, y, 1), value(x, y, 2)};
  const float v = value(x, y, 0);
  return {v, v, v};
}

Rgb Image::nearest(const Vec2f& st, WrapModes wrap) const {
  return texel(floor_to_int(st.x * static_cast<float>(width_)),
               floor_to_int(st.y * static_cast<float>(height_)), wrap);
}

Rgb Image::bilinear(const Vec2f& st, WrapModes wrap) const {
  Footprint f = bilinear_footprint(st, width_, height_, wrap);
  return with_values(pixels_, f, width_, channels_, [&](const auto& values) {
    const float r = weighted(values, f, channels_, 0);
    if (channels_ < 3) return Rgb{r, r, r};
    return Rgb{r, weighted(values, f, channels_, 1), weighted(values, f, channels_, 2)};
  });
}

float Image::nearest_float(const Vec2f& st, WrapModes wrap) const {
  int x = floor_to_int(st.x * static_cast<float>(width_));
  int y = floor_to_int(st.y * static_cast<float>(height_));
  return wrap_pixel(x, y, width_, height_, wrap) ? value(x, y, 0) : 0.0f;
}

float Image::bilinear_float(const Vec2f& st, WrapModes wrap) const {
  if (channels_ == 3) {
    const Rgb c = bilinear(st, wrap);
    return (c.r + c.g + c.b) / 3.0f;
  }
  Footprint f = bilinear_footprint(st, width_, height_, wrap);
  const int channel = channels_ == 4 ? 3 : 0;
  return with_values(pixels_, f, width_, channels_,
                     [&](const auto& values) { return weighted(values, f, channels_, channel); });
}

float Image::nearest_channel(const Vec2f& st, WrapModes wrap, int channel) const {
  int x = floor_to_int(st.x * static_cast<float>(width_));
  int y = floor_to_int(st.y * static_cast<float>(height_));
  if (!wrap_pixel(x, y, width_, height_, wrap)) return 0.0f;
  if (channel == 3 && !has_alpha()) return 1.0f;
  return value(x, y, stored_channel(channel));
}

float Image::bilinear_channel(const Vec2f& st, WrapModes wrap, int channel) const {
  Footprint f = bilinear_footprint(st, width_, height_, wrap);
  if (channel == 3 && !has_alpha()) return f.weight[0] + f.weight[1] + f.weight[2] + f.weight[3];
  const int stored = stored_channel(channel);
  return with_values(pixels_, f, width_, channels_,
                     [&](const auto& values) { return weighted(values, f, channels_, stored); });
}

}  // namespace nephroid
