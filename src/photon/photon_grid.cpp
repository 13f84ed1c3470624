#include "photon/photon_grid.h"

#include <array>
#include <numeric>

#include "core/sampler.h"

namespace nephroid {

namespace {

constexpr uint32_t kMaxCoordinate = (1u << PhotonGrid::kCoordinateBits) - 1;

// Spreads the low 21 bits so that two zero bits follow each.
uint64_t spread_bits(uint64_t v) {
  v &= 0x1fffff;
  v = (v | (v << 32)) & 0x1f00000000ffffull;
  v = (v | (v << 16)) & 0x1f0000ff0000ffull;
  v = (v | (v << 8)) & 0x100f00f00f00f00full;
  v = (v | (v << 4)) & 0x10c30c30c30c30c3ull;
  return (v | (v << 2)) & 0x1249249249249249ull;
}

/// Cells of 2^shift quanta that have a photon; `codes` are sorted.
size_t count_cells(const std::vector<uint64_t>& codes, int shift) {
  size_t cells = 1;
  for (size_t i = 1; i < codes.size(); ++i)
    cells += (codes[i] >> (3 * shift)) != (codes[i - 1] >> (3 * shift));
  return cells;
}

/// Puts photon order[i] in place i, without memory for another set of them. Spoils `order`.
void take_in_order(std::vector<Photon>& photons, std::vector<uint32_t>& order) {
  for (uint32_t first = 0; first < order.size(); ++first) {
    if (order[first] == first) continue;
    const Photon moved = photons[first];
    uint32_t to = first;
    while (order[to] != first) {
      photons[to] = photons[order[to]];
      to = std::exchange(order[to], to);
    }
    photons[to] = moved;
    order[to] = to;
  }
}

}  // namespace

uint64_t PhotonGrid::morton(uint32_t x, uint32_t y, uint32_t z) {
  return spread_bits(x) | (spread_bits(y) << 1) | (spread_bits(z) << 2);
}

uint32_t PhotonGrid::quantize(float x, int axis) const {
  const float q = (x - min_[axis]) / quantum_;
  if (!(q > 0.0f)) return 0;
  return q >= static_cast<float>(kMaxCoordinate) ? kMaxCoordinate : static_cast<uint32_t>(q);
}

const PhotonGrid::Cell* PhotonGrid::Level::find(uint64_t code) const {
  for (uint64_t slot = mix_bits(code) & mask;; slot = (slot + 1) & mask) {
    const Cell& cell = table[slot];
    if (cell.begin == cell.end) return nullptr;
    if (cell.code == code) return &cell;
  }
}

PhotonGrid::PhotonGrid(std::vector<Photon> photons, int max_levels) : photons_(std::move(photons)) {
  if (photons_.empty()) return;
  min_ = max_ = photons_[0].p;
  for (const Photon& photon : photons_)
    for (int i = 0; i < 3; ++i) {
      min_[i] = std::min(min_[i], photon.p[i]);
      max_[i] = std::max(max_[i], photon.p[i]);
    }
  const float extent = max_component(max_ - min_);
  const float magnitude = std::max(max_component(abs(min_)), max_component(abs(max_)));
  reach_slack_ = magnitude * 2 * kMachineEpsilon;
  // Photons that all lie in one point still need a cell of some size.
  quantum_ = std::max({extent, magnitude * 1e-6f, std::numeric_limits<float>::min() * 1e6f}) /
             static_cast<float>(kMaxCoordinate);
  const std::vector<uint64_t> codes = sort();

  // The smallest cells that are worth having hold a few photons each; every doubling up to one cell
  // for all follows.
  int finest = 0;
  for (int shift = 0; shift <= kCoordinateBits; ++shift) {
    finest = shift;
    if (count_cells(codes, shift) * 2 <= codes.size()) break;
  }
  for (int shift = finest; shift <= kCoordinateBits; ++shift) {
    if (static_cast<int>(levels_.size()) == max_levels) break;
    add_level(shift, codes);
  }
  size_t total = photons_.capacity() * sizeof(Photon) + positions_.size() * sizeof(Vec3f) +
                 codes.size() * sizeof(uint64_t);
  for (const Level& level : levels_) total += level.table.size() * sizeof(Cell);
  bytes_ = std::max(bytes_, total);
}

// Stable radix sort by Morton code, 11 bits at a time, so that photons of one cell keep the order
// in which they were traced.
std::vector<uint64_t> PhotonGrid::sort() {
  const size_t n = photons_.size();
  std::vector<uint64_t> codes(n), codes_other(n);
  std::vector<uint32_t> order(n), order_other(n);
  for (size_t i = 0; i < n; ++i) {
    const Vec3f& p = photons_[i].p;
    codes[i] = morton(quantize(p.x, 0), quantize(p.y, 1), quantize(p.z, 2));
  }
  std::iota(order.begin(), order.end(), 0u);
  constexpr int kDigit = 11;
  for (int shift = 0; shift < 3 * kCoordinateBits; shift += kDigit) {
    std::array<uint32_t, 1 << kDigit> start{};
    const auto digit = [&](uint64_t code) { return (code >> shift) & ((1u << kDigit) - 1); };
    for (const uint64_t code : codes) ++start[digit(code)];
    uint32_t sum = 0;
    for (uint32_t& s : start) sum += std::exchange(s, sum);
    for (size_t i = 0; i < n; ++i) {
      const uint32_t to = start[digit(codes[i])]++;
      codes_other[to] = codes[i];
      order_other[to] = order[i];
    }
    codes.swap(codes_other);
    order.swap(order_other);
  }
  bytes_ = photons_.capacity() * sizeof(Photon) +
           n * (2 * sizeof(uint64_t) + 2 * sizeof(uint32_t) + sizeof(Vec3f));
  take_in_order(photons_, order);
  positions_.resize(n);
  for (size_t i = 0; i < n; ++i) positions_[i] = photons_[i].p;
  return codes;
}

void PhotonGrid::add_level(int shift, const std::vector<uint64_t>& codes) {
  Level level;
  level.shift = shift;
  level.table.resize(std::bit_ceil(2 * count_cells(codes, shift)));
  level.mask = level.table.size() - 1;
  for (size_t begin = 0; begin < codes.size();) {
    const uint64_t code = codes[begin] >> (3 * shift);
    size_t end = begin + 1;
    while (end < codes.size() && (codes[end] >> (3 * shift)) == code) ++end;
    uint64_t slot = mix_bits(code) & level.mask;
    while (level.table[slot].begin != level.table[slot].end) slot = (slot + 1) & level.mask;
    level.table[slot] = {code, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
    begin = end;
  }
  levels_.push_back(std::move(level));
}

// The finest level whose cells are at least as large as the query's diameter: at most eight cells.
const PhotonGrid::Level& PhotonGrid::level_for(float radius) const {
  size_t i = 0;
  while (i + 1 < levels_.size() && std::ldexp(quantum_, levels_[i].shift) < 2.0f * radius) ++i;
  return levels_[i];
}

}  // namespace nephroid
