#include "photon/photon_order.h"

#include <array>
#include <numeric>
#include <utility>

namespace nephroid {

uint64_t morton_code(uint32_t x, uint32_t y, uint32_t z) {
  return spread_bits(x) | (spread_bits(y) << 1) | (spread_bits(z) << 2);
}

// Radix sort, 11 bits at a time.
std::vector<uint32_t> sort_codes(std::vector<uint64_t>& codes) {
  const size_t n = codes.size();
  std::vector<uint64_t> codes_other(n);
  std::vector<uint32_t> order(n), order_other(n);
  std::iota(order.begin(), order.end(), 0u);
  constexpr int kDigit = 11, kBits = 63;
  for (int shift = 0; shift < kBits; shift += kDigit) {
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
  return order;
}

// The places are far apart, so a second index runs ahead along the cycle and prefetches the photons
// to be moved next.
void take_in_order(std::vector<Photon>& photons, std::vector<uint32_t>& order) {
  constexpr int kAhead = 12;
  for (uint32_t first = 0; first < order.size(); ++first) {
    if (order[first] == first) continue;
    uint32_t ahead = first;
    const auto run_ahead = [&] {
      if (order[ahead] == first) return;
      ahead = order[ahead];
      const char* photon = reinterpret_cast<const char*>(&photons[ahead]);
      __builtin_prefetch(photon, 1);
      __builtin_prefetch(photon + sizeof(Photon) - 1, 1);
    };
    for (int i = 0; i < kAhead; ++i) run_ahead();
    const Photon moved = photons[first];
    uint32_t to = first;
    while (order[to] != first) {
      run_ahead();
      photons[to] = photons[order[to]];
      to = std::exchange(order[to], to);
    }
    photons[to] = moved;
    order[to] = to;
  }
}

}  // namespace nephroid
