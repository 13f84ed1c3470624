// The point of the Sobol' sequence behind a camera path: which dimension each decision has, so that
// those that are integrated together are even together (docs/estimators.md, section 25).
// Who calls it: whoever traces camera walks. It must not know what they are for.
#pragma once

#include "core/sampler.h"

namespace nephroid {

/// Dimensions that are dealt to camera paths; others that go with the same index come after them.
inline constexpr int kEyePathDimensions = 96;

/// The dimension of the Sobol' sequence that decision `d` of walk.h has, from 0 up to, but not
/// including, kEyePathDimensions.
int eye_dimension(int d);

/// Point number `index` of a pixel. Decisions from kEyePathDimensions on have their own dimensions,
/// if `dimensions` goes so far, else independent numbers.
SobolPoint eye_point(uint32_t index, int dimensions = kSobolDimensions);

}  // namespace nephroid
