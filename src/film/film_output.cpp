// The layers of the output file, row by row.
#include "film/film_output.h"

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/parallel.h"
#include "film/exr_file.h"

namespace nephroid {
namespace {

constexpr int64_t kOutputRowsPerChunk = 16;

void add_layer(std::vector<std::string>& channels, const std::string& layer, const char* letters) {
  for (const char* letter = letters; *letter != '\0'; ++letter)
    channels.push_back(layer.empty() ? std::string(1, *letter) : layer + "." + *letter);
}

std::vector<std::string> channel_names(const Film& film) {
  std::vector<std::string> channels;
  add_layer(channels, "", "RGB");
  for (const std::string& route : film.layout().routes) add_layer(channels, route, "RGB");
  for (const std::string& aov : film.layout().aovs) add_layer(channels, aov, "RGB");
  if (film.rejection() != nullptr) add_layer(channels, "outliers", "RGB");
  const bool gbuffer = film.settings().gbuffer, has_error = film.layout().has_error;
  add_layer(channels, gbuffer ? "Albedo" : "albedo", "RGB");
  add_layer(channels, "N", "XYZ");
  if (gbuffer) {
    add_layer(channels, "P", "XYZ");
    add_layer(channels, "Ns", "XYZ");
    for (const char* name : {"u", "v", "dzdx", "dzdy"}) channels.emplace_back(name);
    if (has_error) add_layer(channels, "Variance", "RGB");
    if (has_error) add_layer(channels, "RelativeVariance", "RGB");
  }
  add_layer(channels, "", "Z");
  if (has_error) add_layer(channels, "stderr", "RGB");
  if (film.has_bias()) channels.emplace_back("bias.Y");
  channels.emplace_back("samples");
  return channels;
}

float* put(float* out, const Vec3f& v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
  return out + 3;
}

float* put(float* out, const Rgb& color) {
  out[0] = color.r;
  out[1] = color.g;
  out[2] = color.b;
  return out + 3;
}

/// Writes the further layers of pbrt-v4's gbuffer film; `samples` is the pixel's number of
/// estimates.
float* put_gbuffer(float* out, const Film& film, int x, int y, uint64_t samples) {
  const SurfaceSample s = film.surface(x, y);
  out = put(out, s.p);
  out = put(out, s.ns);
  for (const float value : {s.uv.x, s.uv.y, s.dzdx, s.dzdy}) *out++ = value;
  if (!film.layout().has_error) return out;
  // Variance of a single sample, and the same over the mean.
  const Rgb error = film.standard_error(x, y), mean = film.value(x, y);
  const float n = static_cast<float>(samples);
  const Rgb variance{error.r * error.r * n, error.g * error.g * n, error.b * error.b * n};
  out = put(out, variance);
  for (int c = 0; c < 3; ++c) *out++ = mean[c] == 0 ? 0 : variance[c] / mean[c];
  return out;
}

/// False for layers that need all digits: the picture, scene units, variances and counts.
bool may_be_in_half(const std::string& channel) {
  static constexpr std::array<std::string_view, 4> kLayersInFloat = {"", "P", "Variance",
                                                                     "RelativeVariance"};
  const size_t dot = channel.rfind('.');
  const std::string_view layer =
      dot == std::string::npos ? std::string_view() : std::string_view(channel).substr(0, dot);
  return std::ranges::find(kLayersInFloat, layer) == kLayersInFloat.end();
}

/// [channel]: true if it may be written as 16-bit floats.
std::vector<bool> channels_in_half(const PictureHead& head, LayerPrecision precision) {
  std::vector<bool> may_be_half(head.channels.size(), false);
  if (precision == LayerPrecision::kHalf)
    for (size_t i = 0; i < may_be_half.size(); ++i)
      may_be_half[i] = may_be_in_half(head.channels[i]);
  return may_be_half;
}

/// Writes a colour of `space` as three bytes in sRGB.
uint8_t* put_srgb8(uint8_t* out, Rgb color, const RgbColorSpace* space, float exposure) {
  color = converted(color, space, nullptr);
  for (int c = 0; c < 3; ++c) *out++ = encode_srgb8(color[c] * exposure);
  return out;
}

/// Calls body(y) for each row of the film, rows in parallel.
template <class Body>
void for_each_row(const Film& film, const Body& body) {
  parallel_chunks(film.bounds().height(), kOutputRowsPerChunk,
                  [&](int64_t, int64_t begin, int64_t end) {
                    for (int64_t row = begin; row < end; ++row)
                      body(film.bounds().y0 + static_cast<int>(row));
                  });
}

}  // namespace

PictureHead film_head(const Film& film, Metadata metadata) {
  PictureHead head;
  head.full_width = film.settings().width;
  head.full_height = film.settings().height;
  head.window = film.bounds();
  head.channels = channel_names(film);
  head.color_space = film.settings().color_space;
  head.metadata = std::move(metadata);
  return head;
}

void film_row(const Film& film, int y, float* out) {
  const int routes = static_cast<int>(film.layout().routes.size());
  const int aovs = static_cast<int>(film.layout().aovs.size());
  for (int x = film.bounds().x0; x < film.bounds().x1; ++x) {
    const uint64_t samples = film.samples(x, y);
    out = put(out, film.value(x, y));
    for (int r = 0; r < routes; ++r) out = put(out, film.route_value(r, x, y));
    for (int a = 0; a < aovs; ++a) out = put(out, film.aov_value(a, x, y));
    if (film.rejection() != nullptr) out = put(out, film.outliers(x, y));
    out = put(out, film.albedo(x, y));
    const bool gbuffer = film.settings().gbuffer;
    out = put(out, gbuffer ? film.surface(x, y).n : film.normal(x, y));
    if (gbuffer) out = put_gbuffer(out, film, x, y, samples);
    *out++ = film.depth(x, y);
    if (film.layout().has_error) out = put(out, film.standard_error(x, y));
    if (film.has_bias()) *out++ = film.bias(x, y);
    *out++ = static_cast<float>(samples);
  }
}

Picture film_picture(const Film& film, Metadata metadata) {
  Picture picture{film_head(film, std::move(metadata)), {}};
  const size_t row = picture.channels.size() * static_cast<size_t>(picture.width());
  picture.pixels.resize(row * static_cast<size_t>(picture.height()));
  for_each_row(film, [&](int y) {
    film_row(film, y, picture.pixels.data() + row * static_cast<size_t>(y - picture.window.y0));
  });
  return picture;
}

void write_film_exr(const std::string& path, const Film& film, Metadata metadata,
                    LayerPrecision precision) {
  const PictureHead head = film_head(film, std::move(metadata));
  write_exr(path, head, channels_in_half(head, precision),
            [&](int y, float* row) { film_row(film, y, row); });
}

std::vector<uint8_t> film_srgb8(const Film& film, float exposure) {
  const PixelBounds& bounds = film.bounds();
  std::vector<uint8_t> bytes(bounds.area() * 3);
  for_each_row(film, [&](int y) {
    const size_t row = static_cast<size_t>(y - bounds.y0) * bounds.width();
    uint8_t* out = bytes.data() + row * 3;
    for (int x = bounds.x0; x < bounds.x1; ++x)
      out = put_srgb8(out, film.value(x, y), film.settings().color_space, exposure);
  });
  return bytes;
}

std::vector<uint8_t> picture_srgb8(const Picture& picture, float exposure) {
  const size_t channels = picture.channels.size();
  const int r = picture.find_channel("R"), g = picture.find_channel("G"),
            b = picture.find_channel("B");
  std::vector<uint8_t> bytes(picture.window.area() * 3);
  uint8_t* out = bytes.data();
  for (size_t i = 0; i < picture.pixels.size(); i += channels) {
    const auto value = [&](int channel) {
      return channel < 0 ? 0.0f : picture.pixels[i + static_cast<size_t>(channel)];
    };
    out = put_srgb8(out, {value(r), value(g), value(b)}, picture.color_space, exposure);
  }
  return bytes;
}

void write_film(const std::string& path, const Film& film, Metadata metadata, float exposure,
                LayerPrecision precision) {
  write_film_exr(path, film, std::move(metadata), precision);
  write_preview(path, film, exposure);
}

void write_picture(const std::string& path, const Picture& picture, float exposure,
                   LayerPrecision precision) {
  const size_t row = static_cast<size_t>(picture.width()) * picture.channels.size();
  write_exr(path, picture, channels_in_half(picture, precision), [&](int y, float* out) {
    const size_t first = row * static_cast<size_t>(y - picture.window.y0);
    std::copy_n(picture.pixels.begin() + static_cast<ptrdiff_t>(first), row, out);
  });
  write_png(png_path_beside(path), picture.width(), picture.height(),
            picture_srgb8(picture, exposure));
}

LayerPrecision exact_precision(const Picture& picture) {
  const std::vector<bool> may_be_half = channels_in_half(picture, LayerPrecision::kHalf);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    const float value = picture.pixels[i];
    const bool is_exact = value == static_cast<float>(Imath::half(value)) || std::isnan(value);
    if (may_be_half[i % may_be_half.size()] && !is_exact) return LayerPrecision::kFloat;
  }
  return LayerPrecision::kHalf;
}

void write_preview(const std::string& path, const Film& film, float exposure) {
  write_png(png_path_beside(path), film.bounds().width(), film.bounds().height(),
            film_srgb8(film, exposure));
}

std::string png_path_beside(const std::string& exr_path) {
  return std::filesystem::path(exr_path).replace_extension(".png").string();
}

}  // namespace nephroid
