// Outlier rejection: holds estimates that are isolated in position and log brightness, exactly,
// until later passes confirm them ([O1] to [O4] in docs/estimators.md). It must not know scenes or
// estimators. Paper: DeCoro, Weyrich & Rusinkiewicz, Density-based Outlier Rejection in Monte Carlo
// Rendering, Pacific Graphics 2010.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/color.h"
#include "film/fixed_sum.h"

namespace nephroid {

struct OutlierSettings {
  /// [group]: pixels that one light path exposes in a pass, at least 1. Their estimates are
  /// correlated.
  std::vector<float> exposed_pixels;
  int neighbours = 8;  ///< similar estimates around an estimate that are needed to confirm it
};

class OutlierRejection {
 public:
  /// Adds sums to the picture, one for each part of a group.
  using Release = std::function<void(int group, size_t pixel, std::span<const RgbSum> parts)>;

  /// For a picture of width x height pixels; parts[group] is the group's number of parts.
  OutlierRejection(int width, int height, std::vector<size_t> parts, OutlierSettings settings);

  /// Upper bound of the memory for each pixel of a group with this number of parts.
  static constexpr size_t bytes_per_pixel(size_t parts) {
    return sizeof(Pixel) + kMaxHeld * parts * sizeof(RgbSum);
  }

  /// Counts an estimate and holds it until the end of the pass. False if it need not be held: the
  /// caller adds it to the picture. If the pixel already holds kMaxHeld brightnesses, the darkest
  /// one is released. Different threads may use different pixels.
  bool hold(int group, size_t pixel, std::span<const Rgb> values, const Release& release);

  /// Releases a group's confirmed estimates after a pass. `estimates` is the number per pixel so
  /// far, `shown` the brightness of the shown picture, by pixel. The result does not depend on
  /// threads; `release` is called from several, for different pixels.
  void finish_pass(int group, uint64_t estimates, std::span<const float> shown,
                   const Release& release);

  /// Held light of a group in a pixel, summed over parts.
  RgbSum held(int group, size_t pixel) const;
  /// Number of held estimates in all groups and pixels.
  uint64_t held_estimates() const;

  /// Save and load the state as at most most_words() words. load() throws IoError if they are
  /// invalid.
  std::vector<uint32_t> save() const;
  void load(std::span<const uint32_t> words);
  size_t most_words() const;

  /// Brightness of a colour: the largest magnitude of its components.
  static float brightness(const Rgb& color);
  int neighbours() const { return settings_.neighbours; }

  static constexpr int kMaxHeld = 4;           ///< brightnesses held per pixel and group
  static constexpr int kWindowRadius = 2;      ///< pixels: the window is 5 x 5
  static constexpr int kWideWindowRadius = 8;  ///< the wide one is 17 x 17

 private:
  /// Octaves of brightness, 2^-32 to 2^31; values outside are clamped.
  static constexpr int kLevels = 64;

  /// One pixel of one group, without the held sums.
  struct PixelHead {
    std::array<uint8_t, kLevels> counts{};  ///< [octave]: number of estimates, saturating
    uint64_t confirmed = 0;                 ///< bits of octaves that are no longer held
    std::array<uint8_t, kMaxHeld> levels{};
    std::array<uint32_t, kMaxHeld> estimates{};
    uint32_t size = 0;
  };
  static_assert(std::has_unique_object_representations_v<PixelHead>);
  /// Held sums in the order of `levels`, the parts of one level together.
  struct Pixel : PixelHead {
    std::vector<RgbSum> sums;

    std::span<RgbSum> parts_of(size_t slot, size_t parts) {
      return {sums.data() + slot * parts, parts};
    }
    void remove(size_t slot, size_t parts);
  };
  struct Window {
    int x0, y0, x1, y1;
    int area() const { return (x1 - x0) * (y1 - y0); }
  };
  Window window_around(size_t pixel, int radius) const;
  /// Number of estimates within one octave of `level`.
  uint64_t similar_in(const Window& window, int group, int level) const;
  /// Number of the pixel's estimates that are brighter, or at most one octave darker.
  uint64_t as_bright_in(int group, size_t pixel, int level) const;
  bool is_confirmed(int group, size_t pixel, int level, uint64_t estimates,
                    std::span<const float> shown) const;

  int width_, height_;
  std::vector<size_t> parts_;  ///< [group]
  OutlierSettings settings_;
  std::vector<std::vector<Pixel>> pixels_;  ///< [group][pixel]
};

}  // namespace nephroid
