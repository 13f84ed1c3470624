// The index at the end of a state file: its picture and the location of each section. It must not
// know what the sections mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/film_format.h"
#include "film/image_io.h"

namespace nephroid {

struct StateIndex {
  struct Section {
    std::string name;
    uint32_t words = 1;            ///< 32-bit words per item
    uint64_t bytes = 0;            ///< unpacked size
    uint64_t hash = 0;             ///< hash of the unpacked bytes
    uint64_t offset = 0;           ///< offset of its first block in the file; the others follow
    std::vector<uint32_t> blocks;  ///< [block]: packed size

    size_t stride() const { return size_t{4} * words; }
    /// Unpacked size of each block; the last one has the rest.
    size_t block_bytes() const;
    /// Number of blocks.
    size_t block_count() const;
  };

  Vec2i resolution{0, 0};  ///< full picture, in pixels
  PixelBounds window;      ///< rendered part
  Metadata metadata;
  std::vector<Section> sections;

  std::vector<std::byte> to_bytes() const;
  /// Throws IoError, without the file's name, for invalid bytes and for blocks outside of the first
  /// `file_bytes` of the file.
  static StateIndex from_bytes(std::span<const std::byte> bytes, uint64_t file_bytes);
};

}  // namespace nephroid
