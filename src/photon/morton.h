// Morton codes: neighbours in space are neighbours in this order, and a run of it with a common
// prefix is a cell.
#pragma once

#include <cstdint>

namespace nephroid {

/// Spreads the low 21 bits so that two zero bits follow each.
constexpr uint64_t spread_bits(uint64_t v) {
  v &= 0x1fffff;
  v = (v | (v << 32)) & 0x1f00000000ffffull;
  v = (v | (v << 16)) & 0x1f0000ff0000ffull;
  v = (v | (v << 8)) & 0x100f00f00f00f00full;
  v = (v | (v << 4)) & 0x10c30c30c30c30c3ull;
  return (v | (v << 2)) & 0x1249249249249249ull;
}
/// The code of a cell, from at most 21 bits for each axis.
constexpr uint64_t morton_code(uint32_t x, uint32_t y, uint32_t z) {
  return spread_bits(x) | (spread_bits(y) << 1) | (spread_bits(z) << 2);
}

}  // namespace nephroid
