// Image files -> Image, read whole or tile by tile. OpenImageIO shows in image_input.h only.
// Who calls it: the texture library (through ImageCache) and lights with images.
// It must not know what an image is used for.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/errors.h"
#include "scene/texture/color_encoding.h"
#include "scene/texture/image.h"

namespace nephroid {

using ImagePtr = std::shared_ptr<const Image>;

/// Reads EXR, PNG, JPEG, HDR, PFM, TGA, TIFF and BMP files, which are known by their first bytes
/// (TGA by its name). As in pbrt-v4, only PNG files obey `encoding` (sRGB if empty); other integer
/// formats are sRGB and floating-point ones linear. Bytes stay bytes, 16-bit values become half. An
/// image of two channels is grey; one of more needs channels R, G and B. Throws SceneError at
/// `wanted_by` if the file cannot be read (IoError if no scene names it) or is no image of one of
/// these kinds.
ImagePtr read_image(const std::string& path, std::optional<ColorEncoding> encoding,
                    const SourceLocation& wanted_by);
/// The same with the numbers as they are stored, integers from 0 to 1, whatever the format.
ImagePtr read_stored_image(const std::string& path, const SourceLocation& wanted_by);

/// Says that an image cannot be read, with OpenImageIO's reason in one line: file_is_unreadable.
[[noreturn]] void image_is_unreadable(const std::string& path, std::string reason,
                                      const SourceLocation& wanted_by);

/// True if read_image asks for the encoding of this file.
bool image_obeys_encoding(const std::string& path);

/// Bytes that the images of a scene's textures may take if nobody says otherwise.
inline constexpr uint64_t kDefaultTextureMemory = uint64_t{1} << 30;

class TileCache;

/// The images of a scene's textures, by path and encoding. Images are read whole, in the order in
/// which they are asked for, as long as all of them fit three quarters of the limit; the others
/// stay in their files and share what is left for the tiles that are looked at (paged_image.h). The
/// pixels are the same either way.
class ImageCache {
 public:
  explicit ImageCache(uint64_t limit = kDefaultTextureMemory);
  ~ImageCache();
  /// Throws as read_image.
  ImagePtr get(const std::string& path, std::optional<ColorEncoding> encoding,
               const SourceLocation& wanted_by);
  /// Bytes that pixels take now, for all images that came from here.
  uint64_t memory() const;

 private:
  ImagePtr load(const std::string& path, std::optional<ColorEncoding> encoding,
                const SourceLocation& wanted_by);

  uint64_t limit_;
  uint64_t whole_ = 0;  ///< bytes of images that were read whole
  std::shared_ptr<TileCache> tiles_;
  std::map<std::pair<std::string, std::optional<ColorEncoding>>, ImagePtr> images_;
};

}  // namespace nephroid
