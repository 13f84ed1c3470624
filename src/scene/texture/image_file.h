// Reads image files as Image, whole or tile by tile. It must not know what an image is used for.
// OpenImageIO appears in image_input.h only.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/errors.h"
#include "input/scene_files.h"
#include "scene/texture/color_encoding.h"
#include "scene/texture/image.h"

namespace nephroid {

using ImagePtr = std::shared_ptr<const Image>;

/// Reads EXR, PNG, JPEG, WebP, HDR, PFM, TGA, TIFF and BMP files, detected by their first bytes
/// (TGA by name); in memory PNG, JPEG, WebP and PFM only. Integers have the `encoding` (sRGB if
/// empty), floating-point values are linear. Bytes stay bytes, 16-bit values become half. Two
/// channels are grey and alpha; more than two must include R, G and B. Throws SceneError at
/// `wanted_by` (IoError if no scene names the file) if the file cannot be read or has another
/// format.
ImagePtr read_image(const FileSource& source, std::optional<ColorEncoding> encoding,
                    const SourceLocation& wanted_by);
/// The same without decoding: stored numbers, integers mapped to [0,1], for all formats.
ImagePtr read_stored_image(const FileSource& source, const SourceLocation& wanted_by);

/// Throws the error of an unreadable image (file_is_unreadable), with OpenImageIO's reason in one
/// line.
[[noreturn]] void image_is_unreadable(const std::string& path, std::string reason,
                                      const SourceLocation& wanted_by);

/// True if pbrt-v4 uses the encoding that a scene gives for this file: for PNG only.
bool image_obeys_encoding(const std::string& path);

/// Default limit of the bytes used by a scene's texture images.
inline constexpr uint64_t kDefaultTextureMemory = uint64_t{1} << 30;

class TileCache;

/// The images of a scene's textures, by path and encoding. Images are read whole, in order of
/// request, while all of them fit three quarters of the limit. The others are paged from their
/// files and share the rest of the limit for tiles (paged_image.h). The pixels are the same either
/// way.
class ImageCache {
 public:
  explicit ImageCache(uint64_t limit = kDefaultTextureMemory);
  ~ImageCache();
  /// Throws the errors of read_image.
  ImagePtr get(const FileSource& source, std::optional<ColorEncoding> encoding,
               const SourceLocation& wanted_by);
  /// Bytes that all images of this cache use now.
  uint64_t memory() const;

 private:
  ImagePtr load(const FileSource& source, std::optional<ColorEncoding> encoding,
                const SourceLocation& wanted_by);

  uint64_t limit_;
  uint64_t whole_ = 0;  ///< bytes of the images that were read whole
  std::shared_ptr<TileCache> tiles_;
  std::map<std::pair<std::string, std::optional<ColorEncoding>>, ImagePtr> images_;
};

}  // namespace nephroid
