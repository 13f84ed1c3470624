// White balance: von Kries adaptation with the Bradford cone responses (Lam 1985), as in pbrt-v4.
// It must not know films.
#pragma once

#include "core/color.h"

namespace nephroid {

/// Linear map of rgb values of `space` that gives daylight of a correlated colour temperature the
/// chromaticity of the space's white. Below 4000 K daylight is a black body.
ColorMatrix white_balance(const RgbColorSpace& space, float kelvin);

}  // namespace nephroid
