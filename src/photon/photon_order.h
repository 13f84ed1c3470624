// Sorting photons by Morton code: neighbours in space are neighbours in this order, and a run of it
// whose codes share a prefix is a cell.
#pragma once

#include <cstdint>
#include <vector>

#include "photon/photon.h"

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
/// The code of a cell from its coordinates, at most 21 bits each.
uint64_t morton_code(uint32_t x, uint32_t y, uint32_t z);

/// Sorts codes of at most 63 bits and returns where each one was before. Equal codes keep their
/// order.
std::vector<uint32_t> sort_codes(std::vector<uint64_t>& codes);

/// Memory of sort_codes() per code, the codes and the result included.
inline constexpr size_t kBytesToSortCode = 2 * sizeof(uint64_t) + 2 * sizeof(uint32_t);

/// Moves photon order[i] to place i, in place. Overwrites `order`.
void take_in_order(std::vector<Photon>& photons, std::vector<uint32_t>& order);

}  // namespace nephroid
