// Images that stay in their files: tiles are read on demand and evicted when the tile memory is
// used up. The pixels are those of read_image, bit for bit. It must not know textures.
#pragma once

#include <memory>
#include <string>

#include "core/errors.h"
#include "scene/texture/image.h"

namespace nephroid {

struct ImageInputFile;

/// Tiles of any number of images, used by any number of threads.
class TileCache : public std::enable_shared_from_this<TileCache> {
 public:
  static std::shared_ptr<TileCache> make();
  ~TileCache();
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  /// Limit of the bytes of all tiles together, at least 1 MiB.
  void set_limit(uint64_t bytes);
  /// Bytes that the tiles use now.
  uint64_t memory() const;

  /// The image of an opened file. If it has an alpha channel, it is read once to find out whether
  /// alpha is 1 everywhere. Null if its channels are too far apart. Tiles that cannot be read later
  /// throw like read_image. The image keeps the cache alive.
  std::shared_ptr<const Image> open(ImageInputFile& file, const std::string& path,
                                    const SourceLocation& wanted_by);

  struct Impl;

 private:
  TileCache();
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid
