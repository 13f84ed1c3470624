#include "view/frame.h"

#include <Imath/half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/parallel.h"

namespace nephroid {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are little endian");

constexpr uint32_t kFormatVersion = 1;
constexpr int64_t kValuesPerChunk = 1 << 16;
constexpr size_t kPayloadAlignment = 8;
/// Halves reach 65504. Below 2^-14 they lose digits, so dim layers are scaled up. Bright ones are
/// scaled down by at most kMaxScale, so that their dark parts keep digits; what is brighter still
/// is clipped. NaN and infinity stay what they are: the page marks them.
constexpr float kLargestHalf = 65504, kLargestWanted = 32768, kSmallestWanted = 1.0f / 16;
constexpr float kMaxScale = 64;

/// The tiles of a window.
struct TileGrid {
  int width, height;

  int columns() const { return (width + kTileSize - 1) / kTileSize; }
  int rows() const { return (height + kTileSize - 1) / kTileSize; }
  size_t count() const { return static_cast<size_t>(columns()) * static_cast<size_t>(rows()); }
  /// Pixels of a tile, from the window's corner.
  PixelBounds at(size_t tile) const {
    const int column = static_cast<int>(tile) % columns(), row = static_cast<int>(tile) / columns();
    return {column * kTileSize, row * kTileSize, std::min(width, (column + 1) * kTileSize),
            std::min(height, (row + 1) * kTileSize)};
  }
};

/// Calls body(offset, count) for the rows of a tile: values in a picture of `channels` channels.
template <class Body>
void for_each_row(const TileGrid& grid, size_t tile, size_t channels, const Body& body) {
  const PixelBounds bounds = grid.at(tile);
  for (int y = bounds.y0; y < bounds.y1; ++y)
    body((static_cast<size_t>(y) * grid.width + bounds.x0) * channels, bounds.width() * channels);
}

float largest(const std::vector<float>& values) {
  float result = 0;
  for (const float value : values)
    if (std::isfinite(value)) result = std::max(result, std::abs(value));
  return result;
}

/// The power of two in which values up to `max` are sent: `before`, if that still does.
float scale_for(float max, float before) {
  if (!(max > 0)) return before;
  if (max <= kLargestHalf * before && max >= kSmallestWanted * before) return before;
  if (max <= kLargestWanted && max >= kSmallestWanted) return 1;
  if (max < kSmallestWanted) return std::exp2(std::ceil(std::log2(max)));
  return std::min(kMaxScale, std::exp2(std::ceil(std::log2(max / kLargestWanted))));
}

float clipped(float value) {
  return std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value;
}

std::vector<uint16_t> to_half(const std::vector<float>& values, float scale) {
  std::vector<uint16_t> halves(values.size());
  parallel_chunks(static_cast<int64_t>(values.size()), kValuesPerChunk,
                  [&](int64_t, int64_t begin, int64_t end) {
                    for (int64_t i = begin; i < end; ++i)
                      halves[i] = Imath::half(clipped(values[i] / scale)).bits();
                  });
  return halves;
}

/// Converts colours to linear sRGB, which pages show. Null is sRGB.
void to_srgb(std::vector<float>& colors, const RgbColorSpace* space) {
  if (space == nullptr || space->name() == "srgb") return;
  for (size_t i = 0; i + 2 < colors.size(); i += 3) {
    const Rgb color = converted({colors[i], colors[i + 1], colors[i + 2]}, space, nullptr);
    for (int c = 0; c < 3; ++c) colors[i + static_cast<size_t>(c)] = color[c];
  }
}

/// A layer without versions of its tiles, in the scale `before` if that still does.
std::shared_ptr<FrameLayer> new_frame(const std::string& name, const std::string& channels,
                                      std::vector<float> values, const RgbColorSpace* space,
                                      float before) {
  // Errors have no colour; all else with R, G and B is light or a colour.
  if (channels == "RGB" && name != "stderr") to_srgb(values, space);
  auto frame = std::make_shared<FrameLayer>();
  frame->name = name;
  frame->channels = channels;
  frame->scale = scale_for(largest(values), before);
  frame->pixels = to_half(values, frame->scale);
  return frame;
}

bool is_equal(const FrameLayer& a, const FrameLayer& b, const TileGrid& grid, size_t tile) {
  bool equal = true;
  for_each_row(grid, tile, a.channels.size(), [&](size_t offset, size_t count) {
    equal = equal && std::memcmp(&a.pixels[offset], &b.pixels[offset], count * 2) == 0;
  });
  return equal;
}

}  // namespace

FrameLayerPtr frame_layer(const Film& film, const FilmLayer& layer, uint64_t version,
                          const FrameLayer* before) {
  const TileGrid grid{film.bounds().width(), film.bounds().height()};
  const auto frame = new_frame(layer.name, layer.channels, layer_pixels(film, layer),
                               film.settings().color_space, before ? before->scale : 1);
  frame->tile_versions.assign(grid.count(), version);
  if (before == nullptr || before->scale != frame->scale ||
      before->pixels.size() != frame->pixels.size())
    return frame;
  for (size_t tile = 0; tile < grid.count(); ++tile)
    if (is_equal(*frame, *before, grid, tile))
      frame->tile_versions[tile] = before->tile_versions[tile];
  return frame;
}

FrameLayerPtr frame_layer(const Picture& picture, const std::string& name,
                          const std::string& letters, const std::vector<std::string>& channels) {
  std::vector<size_t> indices;
  for (const std::string& channel : channels) {
    const int index = picture.find_channel(channel);
    if (index < 0) return nullptr;
    indices.push_back(static_cast<size_t>(index));
  }
  const size_t pixels = static_cast<size_t>(picture.width()) * picture.height();
  std::vector<float> values;
  values.reserve(pixels * indices.size());
  for (size_t i = 0; i < pixels; ++i)
    for (const size_t index : indices)
      values.push_back(picture.pixels[i * picture.channels.size() + index]);
  const auto frame = new_frame(name, letters, std::move(values), picture.color_space, 1);
  frame->tile_versions.assign(TileGrid{picture.width(), picture.height()}.count(), 1);
  return frame;
}

std::string encode_frame(const FrameInfo& info, std::span<const FrameLayerPtr> layers,
                         uint64_t since) {
  const TileGrid grid{info.window.width(), info.window.height()};
  std::vector<size_t> tiles;
  for (size_t tile = 0; tile < grid.count(); ++tile)
    if (std::ranges::any_of(
            layers, [&](const FrameLayerPtr& layer) { return layer->tile_versions[tile] > since; }))
      tiles.push_back(tile);

  nlohmann::ordered_json header{
      {"generation", info.generation},
      {"version", info.version},
      {"width", info.width},
      {"height", info.height},
      {"window", {info.window.x0, info.window.y0, info.window.x1, info.window.y1}},
      {"preview", info.is_preview},
      {"tile", kTileSize},
      {"seconds", info.seconds},
      {"passes", info.passes},
      {"layers", nlohmann::ordered_json::array()},
      {"tiles", tiles}};
  for (const FrameLayerPtr& layer : layers)
    header["layers"].push_back(
        {{"name", layer->name}, {"channels", layer->channels}, {"scale", layer->scale}});

  std::string text = header.dump();
  constexpr size_t kPrefix = 4 + 2 * sizeof(uint32_t);
  while ((kPrefix + text.size()) % kPayloadAlignment != 0) text += ' ';
  const uint32_t numbers[2] = {kFormatVersion, static_cast<uint32_t>(text.size())};
  std::string bytes = "NPHV";
  bytes.append(reinterpret_cast<const char*>(numbers), sizeof(numbers));
  bytes += text;
  for (const FrameLayerPtr& layer : layers)
    for (const size_t tile : tiles)
      for_each_row(grid, tile, layer->channels.size(), [&](size_t offset, size_t count) {
        bytes.append(reinterpret_cast<const char*>(&layer->pixels[offset]), count * 2);
      });
  return bytes;
}

}  // namespace nephroid
