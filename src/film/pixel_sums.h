// A sum of colours for each pixel: what the film keeps for a route, an AOV and the squares of
// estimates. A component has 64 bits, and a carry where a sum needs more: few colours do. Exact in
// any order (docs/adr/0044-sums-of-pixels-have-64-bits-and-a-carry.md). It must not know films.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/color.h"
#include "core/zeroed_array.h"
#include "film/fixed_sum.h"

namespace nephroid {

/// Sums in fixed point that saturate at 2^62. Different threads may use different pixels.
class PixelSums {
 public:
  /// Low 64 bits of the components, as a signed number.
  using Words = std::array<int64_t, 3>;
  /// Memory of a pixel, what a carry adds to it, and what that takes in save_carries().
  static constexpr size_t kBytesPerPixel = sizeof(Words);
  static constexpr size_t kCarryBytesPerPixel = 3 * sizeof(int64_t);
  static constexpr size_t kSavedCarryBytesPerPixel = 7 * sizeof(uint32_t);
  /// Fractional bits for colours. A float from 2^-21 on is a multiple of such a step, and sums up
  /// to 2^19 have no carry.
  static constexpr int kColorBits = 44;
  /// Fractional bits for squares of colours, which are smaller where colours are dim. Sums up to
  /// 2^15 have no carry; long renders of bright pixels have larger ones.
  static constexpr int kSquareBits = 48;

  explicit PixelSums(size_t pixels, int fractional_bits = kColorBits);
  PixelSums(const PixelSums& other);
  PixelSums(PixelSums&&) noexcept = default;
  PixelSums& operator=(const PixelSums& other) { return *this = PixelSums(other); }
  PixelSums& operator=(PixelSums&&) noexcept = default;

  /// Add a colour, rounded to the nearest step. False if a component is not finite (its sum is
  /// unchanged) or saturated.
  bool add(size_t pixel, const Rgb& value);
  bool add(size_t pixel, const RgbSum& value);
  /// Adds the sum of a pixel of `other`, which has the same steps. False if a component saturated.
  bool add(size_t pixel, const PixelSums& other);
  void clear(size_t pixel);
  /// The exact sum.
  RgbSum sum(size_t pixel) const;
  bool is_zero(size_t pixel) const;

  /// The words, to be saved and loaded.
  std::span<Words> words() { return words_.items(); }
  /// Save the carries that are not zero, and load them into sums without carries, as at most
  /// most_carry_words() words. load_carries() throws IoError if they are invalid.
  std::vector<uint32_t> save_carries() const;
  void load_carries(std::span<const uint32_t> words);
  size_t most_carry_words() const { return kWordsPerCarry * words_.size(); }

 private:
  using Bits = FixedSum::Bits;
  using PixelCarries = std::array<int64_t, 3>;
  static_assert(sizeof(PixelCarries) == kCarryBytesPerPixel);
  /// Sums saturate at 2 to this power: RgbSum can hold them.
  static constexpr int kLimitExponent = 62;
  /// Words of a saved carry: the pixel, and two for each component.
  static constexpr size_t kWordsPerCarry = kSavedCarryBytesPerPixel / sizeof(uint32_t);
  /// An array that is made when a sum first needs it.
  struct Carries {
    std::once_flag once;
    std::atomic<bool> exist = false;
    ZeroedArray<PixelCarries> of_pixels;
  };

  /// Largest magnitude of a sum, in steps, and of its carry.
  Bits most_steps() const { return Bits{1} << (kLimitExponent + fractional_bits_); }
  int64_t most_carry() const { return static_cast<int64_t>(most_steps() >> 64); }
  /// Bits of a FixedSum below a step.
  int dropped_bits() const { return FixedSum::kFractionalBits - fractional_bits_; }
  /// Steps of a FixedSum, to nearest, ties away from zero: x and -x cancel.
  Bits rounded(Bits sum) const;
  /// A component's sum in steps.
  Bits steps(size_t pixel, size_t c) const;
  void set_steps(size_t pixel, size_t c, Bits steps);
  bool add_steps(size_t pixel, size_t c, Bits added);
  bool have_carries() const { return carries_->exist.load(std::memory_order_acquire); }
  ZeroedArray<PixelCarries>& made_carries();

  int fractional_bits_;
  ZeroedArray<Words> words_;
  std::unique_ptr<Carries> carries_;
};

}  // namespace nephroid
