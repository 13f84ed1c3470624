// Compresses blocks of a state: shuffles bytes (first byte of every item, then the second, ...),
// then Zstandard. It must not know what the items mean.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace nephroid {

/// A block on its way, whose memory serves the next one, too.
struct PackedBlock {
  std::vector<std::byte> packed;
  std::vector<std::byte> planes;  ///< the bytes of equal place together, before or after packing
};

/// Packs items of `stride` bytes each. Sums differ in their middle bytes and hardly anywhere else,
/// which compresses best where bytes of equal place are neighbours (the shuffle of Blosc).
void pack_block(std::span<const std::byte> items, size_t stride, PackedBlock& block);

/// Fills `items`; false if what is packed is no block of exactly so many bytes.
bool unpack_block(PackedBlock& block, size_t stride, std::span<std::byte> items);

}  // namespace nephroid
