// The chromaticities by which EXR files describe colour spaces.
#pragma once

#include <array>
#include <span>

#include "core/color.h"

namespace nephroid {

/// x and y of red, green, blue and white.
std::array<float, 8> chromaticities(const RgbColorSpace& space);

/// The colour space with these 8 chromaticities, up to rounding; null if it is unknown.
const RgbColorSpace* color_space_with(std::span<const float> chromaticities);

}  // namespace nephroid
