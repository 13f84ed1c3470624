// Images that stay in their files: tiles are read when somebody looks at them, and forgotten when
// the memory for all tiles is used up. The pixels are those of read_image, bit for bit.
// Who calls it: the cache of images in image_file.cpp. It must not know textures.
#pragma once

#include <memory>
#include <string>

#include "core/errors.h"
#include "scene/texture/image.h"

namespace nephroid {

struct ImageInputFile;

/// The tiles of any number of images, read by any number of threads.
class TileCache : public std::enable_shared_from_this<TileCache> {
 public:
  static std::shared_ptr<TileCache> make();
  ~TileCache();
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  /// Bytes that all tiles together may take; fewer than 1 MiB count as 1 MiB.
  void set_limit(uint64_t bytes);
  /// Bytes that the tiles take now.
  uint64_t memory() const;

  /// The image of an opened file, which is read once here if it has an alpha channel that may turn
  /// out to be 1 everywhere. Null if its channels lie too far apart. Tiles that cannot be read
  /// later throw as read_image does. The image keeps the cache alive.
  std::shared_ptr<const Image> open(ImageInputFile& file, const std::string& path,
                                    const SourceLocation& wanted_by);

  struct Impl;

 private:
  TileCache();
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid
