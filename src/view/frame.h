// Pictures as the page gets them: half floats in tiles, so that only what changed is sent.
// docs/view-protocol.md has the format. It must not know the server.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "film/film_layers.h"
#include "film/image_io.h"

namespace nephroid {

/// The edge of a tile in pixels; those at the right and lower edge of a picture are smaller.
inline constexpr int kTileSize = 64;
/// The layer that is the picture itself.
inline constexpr const char* kPictureLayer = "picture";

/// A layer in half floats: value = half * scale, rows from the top, channels interleaved. Colours
/// are linear sRGB.
struct FrameLayer {
  std::string name;
  std::string channels;  ///< a letter for each channel
  float scale = 1;       ///< a power of two
  std::vector<uint16_t> pixels;
  std::vector<uint64_t> tile_versions;  ///< [tile, row by row]: the version that changed it last
};
using FrameLayerPtr = std::shared_ptr<const FrameLayer>;

/// What all layers of a frame have in common.
struct FrameInfo {
  uint64_t generation = 0;  ///< counts edits of scene and settings
  uint64_t version = 0;     ///< counts pictures
  int width = 0, height = 0;
  PixelBounds window;
  bool is_preview = false;  ///< coarse, while the camera moves
  double seconds = 0;
  uint32_t passes = 0;
};

/// A frame's picture, without its other layers.
struct PictureFrame {
  FrameInfo info;
  FrameLayerPtr picture;
};

/// A layer of a film. Tiles equal to those of `before`, which may be null, keep their version.
FrameLayerPtr frame_layer(const Film& film, const FilmLayer& layer, uint64_t version,
                          const FrameLayer* before);

/// A layer of a picture, with a letter for each of its channels. Null if one of those is missing.
FrameLayerPtr frame_layer(const Picture& picture, const std::string& name,
                          const std::string& letters, const std::vector<std::string>& channels);

/// The bytes of a frame with the tiles that changed after version `since`; all for 0.
std::string encode_frame(const FrameInfo& info, std::span<const FrameLayerPtr> layers,
                         uint64_t since);

}  // namespace nephroid
