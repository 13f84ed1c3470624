#include "film/film_layers.h"

#include <algorithm>

#include "core/parallel.h"

namespace nephroid {
namespace {

constexpr int64_t kLayerRowsPerChunk = 16;

template <class Triple>
void put3(const Triple& value, float* out) {
  for (int c = 0; c < 3; ++c) out[c] = value[c];
}

}  // namespace

std::vector<FilmLayer> film_layers(const Film& film) {
  std::vector<FilmLayer> layers;
  layers.push_back({"picture", "RGB",
                    [](const Film& f, int x, int y, float* out) { put3(f.value(x, y), out); }});
  const auto& routes = film.layout().routes;
  for (size_t r = 0; r < routes.size(); ++r)
    layers.push_back({routes[r], "RGB", [r](const Film& f, int x, int y, float* out) {
                        put3(f.route_value(static_cast<int>(r), x, y), out);
                      }});
  const auto& aovs = film.layout().aovs;
  for (size_t a = 0; a < aovs.size(); ++a)
    layers.push_back({aovs[a], "RGB", [a](const Film& f, int x, int y, float* out) {
                        put3(f.aov_value(static_cast<int>(a), x, y), out);
                      }});
  if (film.rejection() != nullptr)
    layers.push_back({"outliers", "RGB", [](const Film& f, int x, int y, float* out) {
                        put3(f.outliers(x, y), out);
                      }});
  layers.push_back({"albedo", "RGB",
                    [](const Film& f, int x, int y, float* out) { put3(f.albedo(x, y), out); }});
  layers.push_back(
      {"N", "XYZ", [](const Film& f, int x, int y, float* out) { put3(f.normal(x, y), out); }});
  layers.push_back(
      {"Z", "Z", [](const Film& f, int x, int y, float* out) { *out = f.depth(x, y); }});
  layers.push_back({"stderr", "RGB", [](const Film& f, int x, int y, float* out) {
                      put3(f.standard_error(x, y), out);
                    }});
  if (film.has_bias())
    layers.push_back(
        {"bias", "Y", [](const Film& f, int x, int y, float* out) { *out = f.bias(x, y); }});
  layers.push_back({"samples", "N", [](const Film& f, int x, int y, float* out) {
                      *out = static_cast<float>(f.samples(x, y));
                    }});
  return layers;
}

std::vector<FilmLayer> film_layers(const Film& film, const std::vector<std::string>& names) {
  const std::vector<FilmLayer> all = film_layers(film);
  std::vector<FilmLayer> found;
  for (const std::string& name : names)
    std::ranges::copy_if(all, std::back_inserter(found),
                         [&](const FilmLayer& layer) { return layer.name == name; });
  return found;
}

std::vector<float> layer_pixels(const Film& film, const FilmLayer& layer) {
  const PixelBounds& bounds = film.bounds();
  const size_t channels = layer.channels.size();
  const size_t row_size = channels * static_cast<size_t>(bounds.width());
  std::vector<float> pixels(row_size * static_cast<size_t>(bounds.height()));
  parallel_chunks(bounds.height(), kLayerRowsPerChunk, [&](int64_t, int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; ++row) {
      float* out = pixels.data() + row_size * static_cast<size_t>(row);
      for (int x = bounds.x0; x < bounds.x1; ++x, out += channels)
        layer.put(film, x, bounds.y0 + static_cast<int>(row), out);
    }
  });
  return pixels;
}

}  // namespace nephroid
