// Which estimates of a film are too isolated to be shown: the density of estimates in picture
// position and log brightness decides, pass by pass (DeCoro, Weyrich & Rusinkiewicz, Density-based
// Outlier Rejection in Monte Carlo Rendering, Pacific Graphics 2010; [O1] to [O4] of
// docs/estimators.md). What is isolated is held, exactly, until later passes confirm it. Who calls
// it: Film, which shows what is held as a layer of its own. It must not know scenes or estimators.
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
  /// [group]: how many pixels one light path exposes in a pass, at least 1; their estimates are not
  /// independent of each other.
  std::vector<float> exposed_pixels;
  int neighbours = 8;  ///< similar estimates around an estimate that confirm it
};

class OutlierRejection {
 public:
  /// Takes sums, one for each part of a group, into the picture.
  using Release = std::function<void(int group, size_t pixel, std::span<const RgbSum> parts)>;

  /// For a picture of width x height pixels, [group] parts each.
  OutlierRejection(int width, int height, std::vector<size_t> parts, OutlierSettings settings);

  /// Memory at most, for each pixel of a group with so many parts.
  static constexpr size_t bytes_per_pixel(size_t parts) {
    return sizeof(Pixel) + kMaxHeld * parts * sizeof(RgbSum);
  }

  /// Counts an estimate and takes it, to be judged at the end of the pass. False if it need not
  /// wait: the caller adds it to the picture. Where a pixel holds estimates of kMaxHeld
  /// brightnesses already, the darkest are released. Pixels may be used by different threads.
  bool hold(int group, size_t pixel, std::span<const Rgb> values, const Release& release);

  /// Judges what a group holds, after a pass: releases what is confirmed, by `estimates` a pixel so
  /// far and by the brightness of the picture that is shown ([pixel]). The result does not depend
  /// on threads; release is called from several, for different pixels.
  void finish_pass(int group, uint64_t estimates, std::span<const float> shown,
                   const Release& release);

  /// What a group holds of a pixel, its parts together.
  RgbSum held(int group, size_t pixel) const;
  /// Estimates that are held, of all groups and pixels.
  uint64_t held_estimates() const;

  /// What it keeps, as words, most_words() at most, and back. load() throws IoError if they make no
  /// sense.
  std::vector<uint32_t> save() const;
  void load(std::span<const uint32_t> words);
  size_t most_words() const;

  /// Brightness of a colour as the density sees it: its largest component in magnitude.
  static float brightness(const Rgb& color);
  int neighbours() const { return settings_.neighbours; }

  static constexpr int kMaxHeld = 4;           ///< brightnesses held for a pixel and group
  static constexpr int kWindowRadius = 2;      ///< pixels: the window is 5 x 5
  static constexpr int kWideWindowRadius = 8;  ///< the wide one is 17 x 17

 private:
  /// Octaves of brightness, 2^-32 to 2^31; what lies outside is at the ends.
  static constexpr int kLevels = 64;

  /// One pixel of one group, but for what is held.
  struct PixelHead {
    std::array<uint8_t, kLevels> counts{};  ///< estimates of an octave, saturating
    uint64_t confirmed = 0;                 ///< octaves that need not wait any more, as bits
    std::array<uint8_t, kMaxHeld> levels{};
    std::array<uint32_t, kMaxHeld> estimates{};
    uint32_t size = 0;
  };
  static_assert(std::has_unique_object_representations_v<PixelHead>);
  /// Held sums are in the order of `levels`, all parts of one together.
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
  /// Estimates within an octave of `level`.
  uint64_t similar_in(const Window& window, int group, int level) const;
  bool is_confirmed(int group, size_t pixel, int level, uint64_t estimates,
                    std::span<const float> shown) const;

  int width_, height_;
  std::vector<size_t> parts_;  ///< [group]
  OutlierSettings settings_;
  std::vector<std::vector<Pixel>> pixels_;  ///< [group][pixel]
};

}  // namespace nephroid
