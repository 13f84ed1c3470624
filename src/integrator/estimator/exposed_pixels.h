// Number of pixels that one path exposes, for EstimatorDescriptor.
#pragma once

#include <algorithm>

#include "core/math.h"
#include "integrator/estimator/integrator_options.h"
#include "scene/pixel_filter.h"

namespace nephroid {

/// Number of pixels within a merge radius given in footprints.
inline float pixels_within(float radius) {
  return std::max(1.0f, kPi * sqr(radius));
}
/// Number of pixels whose filter a splat reaches.
inline float splatted_pixels(const PixelFilter& filter) {
  return std::max(1.0f, 4 * filter.radius().x * filter.radius().y);
}
/// EstimatorDescriptor::exposed_pixels of estimators that splat.
inline float pixels_of_splats(const IntegratorOptions&, const PixelFilter& filter, int64_t) {
  return splatted_pixels(filter);
}

}  // namespace nephroid
