// Random numbers as pure functions of the pass key, a stream, an index and a dimension. No
// generator outlives a path, and none belongs to a thread (docs/architecture.md, section 5).
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <span>

#include "core/math.h"

namespace nephroid {

/// The only source of randomness. `pass` counts from 0.
struct PassKey {
  uint64_t seed = 0;
  uint32_t pass = 0;
};

/// A bijective mix of 64 bits with good avalanche (Stafford's variant 13 of the MurmurHash3
/// finaliser).
constexpr uint64_t mix_bits(uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9ull;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebull;
  v ^= v >> 31;
  return v;
}
constexpr uint64_t hash_combine(uint64_t a, uint64_t b) {
  return mix_bits(a * 0x9e3779b97f4a7c15ull + mix_bits(b + 0x632be59bd9b4e019ull));
}
template <class... Rest>
constexpr uint64_t hash_combine(uint64_t a, uint64_t b, Rest... rest) {
  return hash_combine(hash_combine(a, b), rest...);
}
/// The upper 24 bits as a float in [0,1).
constexpr float bits_to_unit_float(uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// Reverses the order of the bits.
constexpr uint32_t reverse_bits(uint32_t v) {
  v = __builtin_bswap32(v);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v >> 4) & 0x0f0f0f0fu);
  v = ((v & 0x33333333u) << 2) | ((v >> 2) & 0x33333333u);
  return ((v & 0x55555555u) << 1) | ((v >> 1) & 0x55555555u);
}

/// Owen's nested uniform scramble of a number in [0,1), given with its bits reversed. It flips each
/// bit by a hash of the bits above it: the hash of Laine & Karras 2011 in Burley's form (JCGT
/// 2020).
constexpr uint32_t owen_scramble_reversed(uint32_t reversed, uint32_t seed) {
  uint32_t v = reversed;
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return reverse_bits(v);
}

/// Number of Sobol' dimensions in use; beyond them a path is random, not stratified.
inline constexpr int kSobolDimensions = 256;

/// Direction numbers (Joe & Kuo 2008), bits reversed, as [bit of the index][dimension].
using SobolDirections = std::array<std::array<uint32_t, kSobolDimensions>, 32>;
const SobolDirections& sobol_directions();

/// One point of the Sobol' sequence in all dimensions, bits reversed, not scrambled. Made once per
/// pass; every pixel scrambles it in its own way.
class SobolPoint {
 public:
  /// With fewer `dimensions` it is made faster; those beyond are random. `order` assigns dimensions
  /// of the sequence to the first decisions, the others keep their own.
  explicit SobolPoint(uint32_t index, int dimensions = kSobolDimensions,
                      std::span<const uint8_t> order = {});
  int dimensions() const { return dimensions_; }
  uint32_t reversed(int dimension) const { return reversed_[dimension]; }
  uint32_t index() const { return index_; }

 private:
  uint32_t index_;
  int dimensions_;
  std::array<uint32_t, kSobolDimensions> reversed_;  ///< the first dimensions_ of them
};

/// A padded point (Kollig & Keller 2002, Burley 2020): each decision has two dimensions, which are
/// stratified over any run of 2^k points from a multiple of 2^k on, independently of other
/// decisions. For few points in two dimensions: many pairs of high Sobol' dimensions are functions
/// of each other for the first 16 points. Camera paths do better with SobolPoint, whose dimensions
/// are stratified together.
struct PaddedPoint {
  uint32_t index = 0;
};

/// The second dimension of the Sobol' sequence at `index`, bits reversed; the first one is the
/// index itself. Bit i is the parity of the index bits at the positions that include all bits of i.
constexpr uint32_t sobol_second_reversed(uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  return index ^ ((index >> 16) & 0x0000ffffu);
}

/// Numbers in [0,1), one per dimension, that come from elsewhere: the state of a Markov chain
/// (Kelemen et al. 2002).
class PrimarySample {
 public:
  virtual ~PrimarySample() = default;
  /// The same number whenever the same dimension is requested.
  virtual float number(int dimension) = 0;
};

/// The random numbers of one path: the dimensions of a scrambled Sobol' point, a padded point or a
/// primary sample, in order. A value depends only on the point's index, the seed and the dimension
/// and, for a padded point, on whether it is read by get_1d() or get_2d().
class PathSampler {
 public:
  /// `point` outlives the sampler.
  PathSampler(const SobolPoint& point, uint64_t seed)
      : point_(&point), seed_(mix_bits(seed)), index_(point.index()) {}
  PathSampler(SobolPoint&&, uint64_t) = delete;
  PathSampler(PaddedPoint point, uint64_t seed)
      : seed_(mix_bits(seed)), index_(point.index), reversed_index_(reverse_bits(point.index)) {}
  /// `primary` outlives the sampler.
  explicit PathSampler(PrimarySample& primary) : primary_(&primary) {}

  /// Jumps to a dimension, so that each decision along a path has its own whatever came before.
  void start_dimension(int dimension) { dimension_ = dimension; }
  int dimension() const { return dimension_; }

  float get_1d() {
    const int d = dimension_++;
    if (primary_) return primary_->number(d);
    const uint64_t h = hash_of(d);
    const uint32_t scramble = static_cast<uint32_t>(h >> 32);
    if (!point_) return bits_to_unit_float(owen_scramble_reversed(shuffled_index(h), scramble));
    if (d < point_->dimensions())
      return bits_to_unit_float(owen_scramble_reversed(point_->reversed(d), scramble));
    return bits_to_unit_float(static_cast<uint32_t>(hash_combine(h, index_) >> 32));
  }
  /// A seed for any number of random numbers of this path and the current dimension.
  uint64_t stream_seed() const {
    if (primary_)
      return hash_combine(std::bit_cast<uint32_t>(primary_->number(dimension_)), dimension_);
    return hash_combine(seed_, index_, dimension_);
  }
  /// An endless sampler for this path and a dimension; each decision is stratified over the points
  /// of the sequence. Not for a PrimarySample.
  PathSampler stream(int dimension) const {
    assert(!primary_);
    return {PaddedPoint{index_}, hash_combine(seed_, dimension)};
  }
  Vec2f get_2d() {
    if (point_ || primary_) {
      const float x = get_1d();
      return {x, get_1d()};
    }
    const uint64_t h = hash_of(dimension_), h2 = hash_of(dimension_ + 1);
    const uint32_t i = shuffled_index(h);
    dimension_ += 2;
    return {bits_to_unit_float(owen_scramble_reversed(i, static_cast<uint32_t>(h >> 32))),
            bits_to_unit_float(
                owen_scramble_reversed(sobol_second_reversed(i), static_cast<uint32_t>(h2 >> 32)))};
  }

 private:
  uint64_t hash_of(int dimension) const {
    return mix_bits(seed_ + dimension * 0x9e3779b97f4a7c15ull);
  }
  /// Shuffles indices; runs of 2^k indices from a multiple of 2^k on stay together.
  uint32_t shuffled_index(uint64_t hash) const {
    return owen_scramble_reversed(reversed_index_, static_cast<uint32_t>(hash));
  }

  const SobolPoint* point_ = nullptr;
  PrimarySample* primary_ = nullptr;  ///< used instead of a point if not null
  uint64_t seed_ = 0;
  uint32_t index_ = 0, reversed_index_ = 0;
  int dimension_ = 0;
};

}  // namespace nephroid
