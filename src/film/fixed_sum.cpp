// Converts doubles to 128-bit fixed point, rounded once to the nearest step. All shifts are of
// unsigned magnitudes: nothing is undefined, and x and -x cancel.
#include "film/fixed_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nephroid {
namespace {

using Bits = FixedSum::Bits;
__extension__ using Magnitude = unsigned __int128;

/// The limits are symmetric, so that -kLimit can be negated.
constexpr Bits kLimit = static_cast<Bits>(~Magnitude{0} >> 1);
/// Exponent field of a double whose mantissa counts steps of 2^-64: 1075 (bias and mantissa) - 64.
constexpr int kExponentOfOneStep = 1011;
constexpr int kMantissaBits = 53;

/// mantissa / 2^shift, to nearest, ties to even.
uint64_t shift_right_rounded(uint64_t mantissa, int shift) {
  if (shift > kMantissaBits) return 0;  // below half a step
  const uint64_t quotient = mantissa >> shift;
  const uint64_t rest = mantissa & ((uint64_t{1} << shift) - 1);
  const uint64_t half = uint64_t{1} << (shift - 1);
  const bool up = rest > half || (rest == half && (quotient & 1) != 0);
  return quotient + (up ? 1 : 0);
}

/// Adds `term`, saturating at the limits. False if it saturated.
bool add_saturating(Bits* sum, Bits term) {
  Bits result = 0;
  const bool overflow = __builtin_add_overflow(*sum, term, &result);
  if (!overflow && result >= -kLimit) {
    *sum = result;
    return true;
  }
  *sum = term < 0 ? -kLimit : kLimit;
  return false;
}

}  // namespace

bool FixedSum::add(double x) {
  if (!std::isfinite(x)) return false;
  const auto pattern = std::bit_cast<uint64_t>(x);
  const bool negative = (pattern >> 63) != 0;
  const int exponent = static_cast<int>((pattern >> 52) & 0x7ff);
  if (exponent == 0) return true;  // zero or subnormal, far below half a step
  const uint64_t mantissa = (pattern & ((uint64_t{1} << 52) - 1)) | (uint64_t{1} << 52);
  const int shift = exponent - kExponentOfOneStep;
  if (shift > 127 - kMantissaBits) {  // |x| >= 2^63
    bits = negative ? -kLimit : kLimit;
    return false;
  }
  const Magnitude magnitude =
      shift >= 0 ? Magnitude{mantissa} << shift : shift_right_rounded(mantissa, -shift);
  const Bits term = static_cast<Bits>(magnitude);
  return add_saturating(&bits, negative ? -term : term);
}

bool FixedSum::add(const FixedSum& other) {
  return add_saturating(&bits, other.bits);
}

bool UnitSum::add(float x) {
  constexpr double kStepsOfOne = 0x1p40, kMaxHeld = 0x1p22;
  if (!std::isfinite(x)) return false;
  // Exact except for the rounding to a step.
  const double held = std::clamp(double{x}, -kMaxHeld, kMaxHeld);
  return add(UnitSum{std::llrint(held * kStepsOfOne)}) && held == double{x};
}

bool UnitSum::add(const UnitSum& other) {
  constexpr int64_t kMaxHigh = std::numeric_limits<int64_t>::max();
  int64_t result = 0;
  const bool overflow = __builtin_add_overflow(bits, other.bits, &result);
  if (overflow || result < -kMaxHigh) {
    bits = other.bits < 0 ? -kMaxHigh : kMaxHigh;
    return false;
  }
  bits = result;
  return true;
}

double UnitSum::value() const {
  return static_cast<double>(bits) * 0x1p-40;
}

double FixedSum::value() const {
  // The conversion rounds to nearest; the scaling by a power of two is exact.
  return static_cast<double>(bits) * 0x1p-64;
}

}  // namespace nephroid
