#include "bench/measure.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "image/compare.h"
#include "image/flip.h"

namespace nephroid {

Picture colors_of_film(const Film& film, std::optional<int> aov) {
  const PixelBounds& b = film.bounds();
  Picture picture;
  picture.full_width = film.settings().width;
  picture.full_height = film.settings().height;
  picture.window = b;
  picture.channels = {"R", "G", "B"};
  picture.color_space = film.settings().color_space;
  picture.pixels.reserve(b.area() * 3);
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x) {
      const Rgb value = aov ? film.aov_value(*aov, x, y) : film.value(x, y);
      picture.pixels.insert(picture.pixels.end(), {value.r, value.g, value.b});
    }
  return picture;
}

Picture layer_of(const Picture& picture, const std::string& layer) {
  size_t channels[3] = {};
  for (size_t c = 0; c < 3; ++c) {
    const int channel = picture.find_channel(layer + "." + "RGB"[c]);
    if (channel < 0)
      throw UsageError("the reference has no layer '" + layer +
                       "', expected one that was rendered with --aov " + layer + "=EXPRESSION");
    channels[c] = channel;
  }
  Picture result = picture;
  result.channels = {"R", "G", "B"};
  result.pixels.clear();
  for (size_t i = 0; i < picture.pixels.size(); i += picture.channels.size())
    for (const size_t channel : channels) result.pixels.push_back(picture.pixels[i + channel]);
  return result;
}

Picture part_of(const Picture& picture, const BenchRegion& region) {
  const auto range = [](float low, float high, int size) {
    const int begin =
        std::clamp(static_cast<int>(std::ceil(low * static_cast<float>(size) - 0.5f)), 0, size - 1);
    const int end = std::clamp(static_cast<int>(std::ceil(high * static_cast<float>(size) - 0.5f)),
                               begin + 1, size);
    return std::pair{begin, end};
  };
  const auto [x0, x1] = range(region.x0, region.x1, picture.width());
  const auto [y0, y1] = range(region.y0, region.y1, picture.height());
  Picture part = picture;
  part.window = {picture.window.x0 + x0, picture.window.y0 + y0, picture.window.x0 + x1,
                 picture.window.y0 + y1};
  part.pixels.clear();
  const std::ptrdiff_t stride = picture.channels.size();
  for (int y = y0; y < y1; ++y) {
    const auto row = picture.pixels.begin() + stride * y * picture.width();
    part.pixels.insert(part.pixels.end(), row + stride * x0, row + stride * x1);
  }
  return part;
}

BenchErrors measure_errors(const Picture& reference, const Picture& test, float exposure) {
  const Comparison c = compare_pictures(reference, test, {});
  return {c.rmse, c.relmse, c.relmse_trim, c.mean.value, flip(reference, test, exposure)};
}

std::optional<double> own_error(const Picture& picture) {
  double sum = 0;
  const size_t stride = picture.channels.size();
  for (const char* name : {"stderr.R", "stderr.G", "stderr.B"}) {
    const int channel = picture.find_channel(name);
    if (channel < 0) return std::nullopt;
    for (size_t i = channel; i < picture.pixels.size(); i += stride)
      sum += static_cast<double>(picture.pixels[i]) * picture.pixels[i];
  }
  return std::sqrt(sum / (3 * static_cast<double>(picture.width()) * picture.height()));
}

}  // namespace nephroid
