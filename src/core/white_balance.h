// White balance: von Kries adaptation with the Bradford cone responses (Lam 1985), as in pbrt-v4.
// It must not know films.
#pragma once

#include "core/color.h"

namespace nephroid {

/// Matrix for rgb values of `space` that maps daylight of the correlated colour temperature
/// `kelvin` to the space's white. Below 4000 K, a black body replaces daylight.
ColorMatrix white_balance(const RgbColorSpace& space, float kelvin);

}  // namespace nephroid
