// The layers of the output file, filled row by row. Rows are independent, so they are filled in
// parallel.
#include "film/film_output.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/parallel.h"
#include "film/exr_file.h"

namespace nephroid {
namespace {

constexpr int64_t kRowsPerChunk = 16;

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
  const bool gbuffer = film.settings().gbuffer;
  add_layer(channels, gbuffer ? "Albedo" : "albedo", "RGB");
  add_layer(channels, "N", "XYZ");
  if (gbuffer) {
    add_layer(channels, "P", "XYZ");
    add_layer(channels, "Ns", "XYZ");
    for (const char* name : {"u", "v", "dzdx", "dzdy"}) channels.emplace_back(name);
    add_layer(channels, "Variance", "RGB");
    add_layer(channels, "RelativeVariance", "RGB");
  }
  add_layer(channels, "", "Z");
  add_layer(channels, "stderr", "RGB");
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

/// The layers that pbrt-v4's gbuffer film has beside the common ones; `samples` is the number of
/// estimates behind a pixel.
float* put_gbuffer(float* out, const Film& film, int x, int y, uint64_t samples) {
  const SurfaceSample s = film.surface(x, y);
  out = put(out, s.p);
  out = put(out, s.ns);
  for (const float value : {s.uv.x, s.uv.y, s.dzdx, s.dzdy}) *out++ = value;
  // Of a single sample, and over the mean.
  const Rgb error = film.standard_error(x, y), mean = film.value(x, y);
  const float n = static_cast<float>(samples);
  const Rgb variance{error.r * error.r * n, error.g * error.g * n, error.b * error.b * n};
  out = put(out, variance);
  for (int c = 0; c < 3; ++c) *out++ = mean[c] == 0 ? 0 : variance[c] / mean[c];
  return out;
}

/// Calls body(y) for each row of the film, rows in parallel.
template <class Body>
void for_each_row(const Film& film, const Body& body) {
  parallel_chunks(film.bounds().height(), kRowsPerChunk, [&](int64_t, int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; ++row) body(film.bounds().y0 + static_cast<int>(row));
  });
}

}  // namespace

Picture film_picture(const Film& film, Metadata metadata) {
  const PixelBounds& bounds = film.bounds();
  const int routes = static_cast<int>(film.layout().routes.size());
  const int aovs = static_cast<int>(film.layout().aovs.size());
  Picture picture;
  picture.full_width = film.settings().width;
  picture.full_height = film.settings().height;
  picture.window = bounds;
  picture.channels = channel_names(film);
  picture.color_space = film.settings().color_space;
  picture.metadata = std::move(metadata);
  const size_t stride = picture.channels.size();
  picture.pixels.resize(bounds.area() * stride);
  for_each_row(film, [&](int y) {
    const size_t row = static_cast<size_t>(y - bounds.y0) * bounds.width();
    float* out = picture.pixels.data() + row * stride;
    for (int x = bounds.x0; x < bounds.x1; ++x) {
      uint64_t samples = 0;
      for (int g = 0; g < film.layout().group_count(); ++g)
        samples = std::max(samples, film.estimates(g, x, y));
      out = put(out, film.value(x, y));
      for (int r = 0; r < routes; ++r) out = put(out, film.route_value(r, x, y));
      for (int a = 0; a < aovs; ++a) out = put(out, film.aov_value(a, x, y));
      if (film.rejection() != nullptr) out = put(out, film.outliers(x, y));
      out = put(out, film.albedo(x, y));
      const bool gbuffer = film.settings().gbuffer;
      out = put(out, gbuffer ? film.surface(x, y).n : film.normal(x, y));
      if (gbuffer) out = put_gbuffer(out, film, x, y, samples);
      *out++ = film.depth(x, y);
      out = put(out, film.standard_error(x, y));
      if (film.has_bias()) *out++ = film.bias(x, y);
      *out++ = static_cast<float>(samples);
    }
  });
  return picture;
}

std::vector<uint8_t> film_srgb8(const Film& film, float exposure) {
  const PixelBounds& bounds = film.bounds();
  const RgbColorSpace* space = film.settings().color_space;
  const bool convert = space != nullptr && space->name() != "srgb";
  std::vector<uint8_t> bytes(bounds.area() * 3);
  for_each_row(film, [&](int y) {
    const size_t row = static_cast<size_t>(y - bounds.y0) * bounds.width();
    uint8_t* out = bytes.data() + row * 3;
    for (int x = bounds.x0; x < bounds.x1; ++x) {
      Rgb color = film.value(x, y);
      if (convert) color = RgbColorSpace::srgb().from_xyz(space->to_xyz(color));
      for (int c = 0; c < 3; ++c) *out++ = encode_srgb8(color[c] * exposure);
    }
  });
  return bytes;
}

void write_film(const std::string& path, const Film& film, Metadata metadata, float exposure,
                const RenderState* state) {
  write_exr(path, film_picture(film, std::move(metadata)), state);
  write_preview(path, film, exposure);
}

void write_preview(const std::string& path, const Film& film, float exposure) {
  write_png(png_path_beside(path), film.bounds().width(), film.bounds().height(),
            film_srgb8(film, exposure));
}

std::string png_path_beside(const std::string& exr_path) {
  return std::filesystem::path(exr_path).replace_extension(".png").string();
}

}  // namespace nephroid
