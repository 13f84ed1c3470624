// The exact accumulator of the film: 128-bit fixed point with steps of 2^-64, so that adding
// commutes and taking away gives back the bits that were there. Who calls it: film, splats and
// outlier rejection. It must not know pixels.
#pragma once

#include <cstdint>

namespace nephroid {

/// Signed 128-bit fixed point with 64 fractional bits; saturates instead of wrapping.
struct FixedSum {
  __extension__ using Bits = __int128;
  Bits bits = 0;
  /// Adds x rounded to the nearest step. False if it was not finite or the sum saturated (the sum
  /// is then unchanged, or at the limit).
  bool add(double x);
  bool add(const FixedSum& other);
  double value() const;
};

/// The sum of numbers of about 1, of albedos and normals: 64-bit fixed point with 40 fractional
/// bits, half as large. Saturates after 2^23 of them.
struct UnitSum {
  int64_t bits = 0;
  /// As FixedSum::add.
  bool add(float x);
  bool add(const UnitSum& other);
  double value() const;
};

/// The sum of colours.
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
