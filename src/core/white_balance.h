// White balance: what a film's sensor makes of the light that it is told to take for white.
// Who calls it: the film's description and whoever turns radiance into colours. It must not know
// films. Method: von Kries adaptation with the Bradford cone responses (Lam 1985), as in pbrt-v4.
#pragma once

#include "core/color.h"

namespace nephroid {

/// Linear map of rgb values of `space` after which daylight of a correlated colour temperature
/// (kelvin, black body below 4000 K) has the chromaticity of the space's white.
ColorMatrix white_balance(const RgbColorSpace& space, float kelvin);

}  // namespace nephroid
