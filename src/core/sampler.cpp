#include "core/sampler.h"

#include <algorithm>
#include <bit>
#include <boost/random/sobol.hpp>

namespace nephroid {

// The library yields the sequence in Gray code order, without its first point. So the point whose
// Gray code is the single bit k has index 2^(k+1) - 1 and is the direction number of that bit.
static SobolDirections make_directions() {
  SobolDirections directions{};
  boost::random::sobol_engine<uint32_t, 32> engine(kSobolDimensions);
  for (uint32_t bit = 0; bit < 32; ++bit) {
    engine.seed(static_cast<uint32_t>((uint64_t{1} << (bit + 1)) - 2));
    for (uint32_t& value : directions[bit]) value = reverse_bits(engine());
  }
  return directions;
}

const SobolDirections& sobol_directions() {
  static const SobolDirections directions = make_directions();
  return directions;
}

SobolPoint::SobolPoint(uint32_t index, int dimensions, std::span<const uint8_t> order)
    : index_(index), dimensions_(dimensions) {
  const SobolDirections& directions = sobol_directions();
  const size_t count = dimensions, dealt = std::min(order.size(), count);
  size_t needed = count;
  for (size_t d = 0; d < dealt; ++d) needed = std::max(needed, size_t{order[d]} + 1);
  // First in the order of the sequence, which compilers vectorize.
  std::array<uint32_t, kSobolDimensions> in_sequence;
  std::fill_n(in_sequence.begin(), needed, 0u);
  for (uint32_t bits = index; bits != 0; bits &= bits - 1) {
    const auto& of_bit = directions[std::countr_zero(bits)];
    for (size_t d = 0; d < needed; ++d) in_sequence[d] ^= of_bit[d];
  }
  for (size_t d = 0; d < dealt; ++d) reversed_[d] = in_sequence[order[d]];
  for (size_t d = dealt; d < count; ++d) reversed_[d] = in_sequence[d];
}

}  // namespace nephroid
