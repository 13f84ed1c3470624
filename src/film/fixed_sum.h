// Exact sums in fixed point, so that additions commute and can be undone: of splats, held light,
// biases and features. Sums of colours are in pixel_sums.h. It must not know pixels.
#pragma once

#include <cstdint>

namespace nephroid {

/// Signed 128-bit fixed point with 64 fractional bits; saturates instead of wrapping.
struct FixedSum {
  __extension__ using Bits = __int128;
  static constexpr int kFractionalBits = 64;
  Bits bits = 0;
  /// Adds x, rounded to the nearest step. False if x is not finite (the sum is unchanged) or the
  /// sum saturated (it is at the limit).
  bool add(double x);
  bool add(const FixedSum& other);
  double value() const;
};

/// A sum of numbers of about 1, such as albedos and normals: 64-bit fixed point with 40 fractional
/// bits, half as large as FixedSum. Saturates after 2^23 of them.
struct UnitSum {
  int64_t bits = 0;
  /// As FixedSum::add.
  bool add(float x);
  bool add(const UnitSum& other);
  double value() const;
};

/// A sum of colours.
struct RgbSum {
  FixedSum rgb[3];
  /// False if a component saturated.
  bool add(const RgbSum& other) {
    bool fits = true;
    for (int c = 0; c < 3; ++c) fits &= rgb[c].add(other.rgb[c]);
    return fits;
  }
};

}  // namespace nephroid
