// Shuffle and compression each make one pass over a block, which fits the cache.
#include "film/packed_blocks.h"

#include <zstd.h>

#include <algorithm>
#include <cassert>

namespace nephroid {
namespace {

/// The fastest level: noise does not compress, and slower levels gain little.
constexpr int kLevel = 1;

}  // namespace

void pack_block(std::span<const std::byte> items, size_t stride, PackedBlock& block) {
  assert(stride > 0 && items.size() % stride == 0);
  const size_t count = items.size() / stride;
  auto& [packed, planes] = block;
  planes.resize(items.size());
  for (size_t plane = 0; plane < stride; ++plane)
    for (size_t i = 0; i < count; ++i) planes[plane * count + i] = items[i * stride + plane];
  packed.resize(ZSTD_compressBound(planes.size()));
  const size_t size =
      ZSTD_compress(packed.data(), packed.size(), planes.data(), planes.size(), kLevel);
  assert(!ZSTD_isError(size));
  packed.resize(size);
}

bool unpack_block(PackedBlock& block, size_t stride, std::span<std::byte> items) {
  auto& [packed, planes] = block;
  planes.resize(items.size());
  const size_t size = ZSTD_decompress(planes.data(), planes.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) || size != items.size()) return false;
  // Zeros are not written to memory that is zero: untouched pages of a film take no memory.
  const auto is_zero = [](std::byte b) { return b == std::byte{0}; };
  if (std::ranges::all_of(planes, is_zero) && std::ranges::all_of(items, is_zero)) return true;
  const size_t count = items.size() / stride;
  for (size_t plane = 0; plane < stride; ++plane)
    for (size_t i = 0; i < count; ++i) items[i * stride + plane] = planes[plane * count + i];
  return true;
}

}  // namespace nephroid
