// The coefficients of the sky model of L. Hosek and A. Wilkie, "An Analytic Model for Full Spectral
// Sky-Dome Radiance", SIGGRAPH 2012, for red, green and blue.
#pragma once

namespace nephroid {

/// Per channel: for ground albedo 0 and 1, turbidity 1 to 10 and six Bernstein polynomials of the
/// sun's elevation, the nine coefficients of the distribution over the sky.
extern const float kHosekWilkieShape[3][1080];
/// Likewise the mean radiance.
extern const float kHosekWilkieRadiance[3][120];

}  // namespace nephroid
