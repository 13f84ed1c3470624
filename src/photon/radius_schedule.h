// How the merge radius shrinks over passes: equations [E1] and [E2] of docs/estimators.md.
#pragma once

#include <cmath>
#include <cstdint>

namespace nephroid {

/// [E2] Knaus & Zwicker 2011: r(i)^2 / r(1)^2 for pass i = `pass` + 1, that is the product of
/// (k + alpha)/(k + 1) over k = 1 .. i-1. In closed form Gamma(i + alpha) / (Gamma(1 + alpha) i!),
/// so that any pass is as cheap as the first.
inline double memoryless_radius_squared(uint32_t pass, double alpha) {
  const double i = static_cast<double>(pass) + 1.0;
  return std::exp(std::lgamma(i + alpha) - std::lgamma(1.0 + alpha) - std::lgamma(i + 1.0));
}

/// [E1] Hachisuka & Jensen 2009: state that a pixel's region shares over passes.
struct SharedStatistics {
  double radius_squared = 0;   ///< 0: no visible point yet
  double count = 0;            ///< N
  double flux[3] = {0, 0, 0};  ///< tau, as rgb

  /// One pass found `found` photons whose filtered, weighted flux is `phi` (it may be negative).
  void update(double found, const double phi[3], double alpha) {
    if (!(found > 0)) {
      for (int c = 0; c < 3; ++c) flux[c] += phi[c];
      return;
    }
    const double kept = count + alpha * found;
    const double ratio = kept / (count + found);
    count = kept;
    radius_squared *= ratio;
    for (int c = 0; c < 3; ++c) flux[c] = (flux[c] + phi[c]) * ratio;
  }
};

}  // namespace nephroid
