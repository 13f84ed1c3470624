// How many pixels one path exposes, for EstimatorDescriptor.
#pragma once

#include <algorithm>

#include "core/math.h"
#include "scene/pixel_filter.h"

namespace nephroid {

/// Of a photon: those within a merge radius in footprints.
inline float pixels_within(float radius) {
  return std::max(1.0f, kPi * sqr(radius));
}
/// Of a splat: those whose filter reaches it.
inline float splatted_pixels(const PixelFilter& filter) {
  return std::max(1.0f, 4 * filter.radius().x * filter.radius().y);
}

}  // namespace nephroid
