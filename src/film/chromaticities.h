// Colour spaces as EXR files tell of them. Who calls it: exr_file.cpp and image_io.cpp.
#pragma once

#include <array>
#include <span>

#include "core/color.h"

namespace nephroid {

/// x and y of red, green, blue and white.
std::array<float, 8> chromaticities(const RgbColorSpace& space);

/// The space that has these, 8 of them, up to rounding; null if it is none that we know.
const RgbColorSpace* color_space_with(std::span<const float> chromaticities);

}  // namespace nephroid
