// Sums of colours for the layers beside the routes, of which a picture may have dozens. A component
// has 64 bits, and a carry where a sum needs more: few pixels do. Exact in any order
// (docs/adr/0039-layers-have-compact-sums.md). It must not know films.
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

/// A colour sum for each pixel: fixed point with steps of 2^-44, saturating at 2^50. Different
/// threads may use different pixels.
class LayerSums {
 public:
  /// Low 64 bits of the components, as a signed number.
  using Words = std::array<int64_t, 3>;
  static constexpr size_t kBytesPerPixel = sizeof(Words);  ///< without carries

  explicit LayerSums(size_t pixels);
  LayerSums(const LayerSums& other);
  LayerSums(LayerSums&&) noexcept = default;
  LayerSums& operator=(const LayerSums& other) { return *this = LayerSums(other); }
  LayerSums& operator=(LayerSums&&) noexcept = default;

  /// Add a colour, rounded to the nearest step. False if a component is not finite (its sum is
  /// unchanged) or saturated.
  bool add(size_t pixel, const Rgb& value);
  bool add(size_t pixel, const RgbSum& value);
  /// Adds the sum of another layer's pixel. False if a component saturated.
  bool add(size_t pixel, const LayerSums& other);
  void clear(size_t pixel);
  /// The exact sum. It is in the range of RgbSum.
  RgbSum sum(size_t pixel) const;

  /// The words, to be saved and loaded.
  std::span<Words> words() { return words_.items(); }
  /// Save the carries that are not zero, and load them into sums without carries, as at most
  /// most_carry_words() words. load_carries() throws IoError if they are invalid.
  std::vector<uint32_t> save_carries() const;
  void load_carries(std::span<const uint32_t> words);
  size_t most_carry_words() const { return kWordsPerCarry * words_.size(); }

 private:
  using Bits = FixedSum::Bits;
  using PixelCarries = std::array<int32_t, 3>;
  static constexpr size_t kWordsPerCarry = 4;  ///< pixel, and its three carries
  /// An array that is made when a sum first needs it.
  struct Carries {
    std::once_flag once;
    std::atomic<bool> exist = false;
    ZeroedArray<PixelCarries> of_pixels;
  };

  /// A component's sum in steps.
  Bits steps(size_t pixel, size_t c) const;
  void set_steps(size_t pixel, size_t c, Bits steps);
  bool add_steps(size_t pixel, size_t c, Bits steps);
  bool have_carries() const { return carries_->exist.load(std::memory_order_acquire); }
  ZeroedArray<PixelCarries>& made_carries();

  ZeroedArray<Words> words_;
  std::unique_ptr<Carries> carries_;
};

}  // namespace nephroid
