// Compresses blocks of a state: shuffles bytes (first byte of every item, then the second, ...),
// then Zstandard. It must not know what the items mean.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace nephroid {

/// A block while it is packed or unpacked; its memory is reused for the next one.
struct PackedBlock {
  std::vector<std::byte> packed;
  std::vector<std::byte> planes;  ///< shuffled bytes, before packing or after unpacking
};

/// Packs items of `stride` bytes each. Sums differ mostly in their middle bytes, so they compress
/// best if bytes of equal position are neighbours (the shuffle of Blosc).
void pack_block(std::span<const std::byte> items, size_t stride, PackedBlock& block);

/// Unpacks a block into `items`. False if it is not a block of exactly this size.
bool unpack_block(PackedBlock& block, size_t stride, std::span<std::byte> items);

}  // namespace nephroid
