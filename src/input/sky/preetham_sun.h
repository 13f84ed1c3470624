// Radiance of the sun through the atmosphere. A. J. Preetham, P. Shirley, B. Smits, "A Practical
// Analytic Model for Daylight", SIGGRAPH 1999, appendix A.1. It must not know images and lights.
#pragma once

#include "core/color.h"

namespace nephroid {

/// Linear sRGB in W / (m^2 sr nm), of the sun's disk at a zenith angle in radians, below pi / 2.
Rgb sun_radiance(double zenith, double turbidity);

}  // namespace nephroid
