#include "photon/photon_grid.h"

#include <array>
#include <utility>

#include "core/sampler.h"
#include "photon/photon_order.h"

namespace nephroid {

namespace {

constexpr uint32_t kMaxCoordinate = (1u << PhotonGrid::kCoordinateBits) - 1;

/// Number of cells of 2^shift quanta with a photon, for each shift; `codes` are sorted.
std::array<size_t, PhotonGrid::kCoordinateBits + 1> count_cells(
    const std::vector<uint64_t>& codes) {
  std::array<size_t, PhotonGrid::kCoordinateBits + 1> cells{};
  // First count, for each shift, the neighbours that the next finer one separates.
  for (size_t i = 1; i < codes.size(); ++i)
    ++cells[(std::bit_width(codes[i] ^ codes[i - 1]) + 2) / 3];
  size_t boundaries = 0;
  for (size_t shift = cells.size(); shift-- > 0;)
    boundaries += std::exchange(cells[shift], boundaries + 1);
  return cells;
}

/// Mean number of photons in the cell of 2^shift quanta around a photon; `codes` are sorted.
size_t mean_neighbours(int shift, const std::vector<uint64_t>& codes) {
  size_t pairs = 0;
  for (size_t begin = 0, end = 0; begin < codes.size(); begin = end) {
    while (end < codes.size() && (codes[end] ^ codes[begin]) >> (3 * shift) == 0) ++end;
    pairs += (end - begin) * (end - begin);
  }
  return pairs / codes.size();
}

}  // namespace

uint32_t PhotonGrid::quantize(float x, int axis) const {
  const float q = (x - min_[axis]) * quanta_;
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

PhotonGrid::PhotonGrid(std::vector<Photon> photons, std::vector<uint32_t>* order)
    : photons_(std::move(photons)) {
  if (photons_.empty()) return;
  min_ = max_ = photons_[0].p;
  for (const Photon& photon : photons_)
    for (int i = 0; i < 3; ++i) {
      min_[i] = std::min(min_[i], photon.p[i]);
      max_[i] = std::max(max_[i], photon.p[i]);
    }
  const float extent = max_component(max_ - min_);
  const float magnitude = std::max(max_component(abs(min_)), max_component(abs(max_)));
  slack_ = magnitude * 2 * kMachineEpsilon;
  // If all photons lie at one point, a cell still needs a size.
  quantum_ = std::max({extent, magnitude * 1e-6f, std::numeric_limits<float>::min() * 1e8f}) /
             static_cast<float>(kMaxCoordinate);
  quanta_ = 1.0f / quantum_;
  const std::vector<uint64_t> codes = sort(order);

  // The finest cells hold a few photons each. Each level doubles the size, up to a single cell.
  const auto counts = count_cells(codes);
  int finest = 0;
  while (finest < kCoordinateBits && counts[finest] * 2 > codes.size()) ++finest;
  // Clustered photons have many more neighbours than that. If there are so few photons that memory
  // does not matter, their cells are smaller.
  constexpr size_t kFew = 1 << 17, kMaxNeighbours = 6;
  if (codes.size() <= kFew)
    while (finest > 0 && mean_neighbours(finest, codes) > kMaxNeighbours) --finest;
  std::vector<Cell> cells = finest_cells(finest, codes, counts[finest]);
  const size_t working = codes.size() * sizeof(uint64_t) + cells.size() * sizeof(Cell);
  for (int shift = finest; shift <= kCoordinateBits; ++shift) {
    add_level(shift, cells);
    join_cells(cells);
  }
  size_t total = photons_.capacity() * sizeof(Photon) + positions_.size() * sizeof(Vec3f) + working;
  for (const Level& level : levels_) total += level.table.size() * sizeof(Cell);
  bytes_ = std::max(bytes_, total);
}

std::vector<uint64_t> PhotonGrid::sort(std::vector<uint32_t>* order_of_all) {
  const size_t n = photons_.size();
  std::vector<uint64_t> codes(n);
  for (size_t i = 0; i < n; ++i) {
    const Vec3f& p = photons_[i].p;
    codes[i] = morton_code(quantize(p.x, 0), quantize(p.y, 1), quantize(p.z, 2));
  }
  std::vector<uint32_t> order = sort_codes(codes);
  bytes_ = photons_.capacity() * sizeof(Photon) + n * (kBytesToSortCode + sizeof(Vec3f));
  if (order_of_all != nullptr) *order_of_all = order;
  take_in_order(photons_, order);
  positions_.resize(n);
  for (size_t i = 0; i < n; ++i) positions_[i] = photons_[i].p;
  return codes;
}

std::vector<PhotonGrid::Cell> PhotonGrid::finest_cells(int shift,
                                                       const std::vector<uint64_t>& codes,
                                                       size_t count) {
  std::vector<Cell> cells;
  cells.reserve(count);
  for (size_t i = 0; i < codes.size(); ++i) {
    const uint64_t code = codes[i] >> (3 * shift);
    if (cells.empty() || cells.back().code != code)
      cells.push_back({code, static_cast<uint32_t>(i), 0});
    cells.back().end = static_cast<uint32_t>(i) + 1;
  }
  return cells;
}

void PhotonGrid::join_cells(std::vector<Cell>& cells) {
  size_t last = 0;
  cells[0].code >>= 3;
  for (size_t i = 1; i < cells.size(); ++i) {
    const Cell cell = {cells[i].code >> 3, cells[i].begin, cells[i].end};
    if (cells[last].code == cell.code)
      cells[last].end = cell.end;
    else
      cells[++last] = cell;
  }
  cells.resize(last + 1);
}

void PhotonGrid::add_level(int shift, const std::vector<Cell>& cells) {
  Level level;
  level.shift = shift;
  level.size = std::ldexp(quantum_, shift);
  level.table.resize(std::bit_ceil(2 * cells.size()));
  level.mask = level.table.size() - 1;
  for (const Cell& cell : cells) {
    uint64_t slot = mix_bits(cell.code) & level.mask;
    while (level.table[slot].begin != level.table[slot].end) slot = (slot + 1) & level.mask;
    level.table[slot] = cell;
  }
  levels_.push_back(std::move(level));
}

// The level is first guessed by size, then the cells themselves are checked, which rounding cannot
// mislead. The last level has a single cell.
const PhotonGrid::Level& PhotonGrid::level_for(float reach, const uint32_t (&lo)[3],
                                               const uint32_t (&hi)[3]) const {
  size_t i = 0;
  while (i + 1 < levels_.size() && levels_[i].size <= 2.0f * reach) ++i;
  const auto too_fine = [&](int shift) {
    bool any = false;
    for (int axis = 0; axis < 3; ++axis) any |= (hi[axis] >> shift) - (lo[axis] >> shift) > 1;
    return any;
  };
  while (too_fine(levels_[i].shift)) ++i;
  return levels_[i];
}

void PhotonGrid::find_runs(const Vec3f& center, float radius, Runs& runs) const {
  // The quantisation is monotonic, so the cells of center +- reach enclose all that can match.
  const float reach = radius * (1.0f + 4 * kMachineEpsilon) + slack_;
  uint32_t lo[3], hi[3];
  for (int i = 0; i < 3; ++i) {
    if (center[i] + reach < min_[i] || center[i] - reach > max_[i]) return;
    lo[i] = quantize(center[i] - reach, i);
    hi[i] = quantize(center[i] + reach, i);
  }
  const Level& level = level_for(reach, lo, hi);
  struct Axis {
    uint64_t code[2];  ///< codes of the lower and the upper cell
    float d2[2];       ///< squared least distances to them along this axis
    int count;         ///< 1 if they are the same cell
  } axes[3];
  for (int i = 0; i < 3; ++i) {
    const uint32_t first = lo[i] >> level.shift, second = hi[i] >> level.shift;
    const float boundary = min_[i] + static_cast<float>(second) * level.size;
    const float away = std::max(0.0f, std::abs(center[i] - boundary) - slack_ - quantum_);
    const bool below = center[i] < boundary;
    axes[i].count = first == second ? 1 : 2;
    axes[i].code[0] = spread_bits(first) << i;
    axes[i].code[1] = spread_bits(second) << i;
    axes[i].d2[0] = first == second || below ? 0.0f : away * away;
    axes[i].d2[1] = below ? away * away : 0.0f;
  }
  const float r2 = reach * reach;
  for (int z = 0; z < axes[2].count; ++z)
    for (int y = 0; y < axes[1].count; ++y)
      for (int x = 0; x < axes[0].count; ++x) {
        if (axes[0].d2[x] + axes[1].d2[y] + axes[2].d2[z] > r2) continue;
        const Cell* cell = level.find(axes[0].code[x] | axes[1].code[y] | axes[2].code[z]);
        if (!cell) continue;
        runs.begin[runs.count] = cell->begin;
        runs.end[runs.count++] = cell->end;
      }
}

}  // namespace nephroid
