// Shrinking merge radii: equations [E1] and [E2] of docs/estimators.md.
#pragma once

#include <cmath>
#include <cstdint>

namespace nephroid {

/// [E2] Knaus & Zwicker 2011: r(i)^2 / r(1)^2 for pass i = `pass` + 1, the product of
/// (k + alpha)/(k + 1) over k = 1 .. i-1. The closed form Gamma(i + alpha) / (Gamma(1 + alpha) i!)
/// makes any pass as cheap as the first. (std::lgamma would write to the global `signgam`.)
inline double memoryless_radius_squared(uint32_t pass, double alpha) {
  const double i = pass + 1.0;
  int sign = 0;
  return std::exp(::lgamma_r(i + alpha, &sign) - ::lgamma_r(1.0 + alpha, &sign) -
                  ::lgamma_r(i + 1.0, &sign));
}

/// [E1] Hachisuka & Jensen 2009: shared statistics of a pixel's region, except for the flux tau.
struct SharedStatistics {
  double radius_squared = 0;  ///< 0: no visible point yet
  double count = 0;           ///< N

  /// Shrinks the radius after a pass that found `found` photons (M). Returns R'^2 / R^2, the factor
  /// of the flux tau + phi.
  double update(double found, double alpha) {
    if (!(found > 0)) return 1.0;
    const double kept = count + alpha * found;
    const double ratio = kept / (count + found);
    count = kept;
    radius_squared *= ratio;
    return ratio;
  }
};

}  // namespace nephroid
