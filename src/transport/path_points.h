// The points of the Sobol' sequence behind a camera path and behind a light path that is connected
// with it: which dimension each decision has, so that those that are integrated together are even
// together (docs/estimators.md, section 25). It must not know what they are for.
#pragma once

#include "core/sampler.h"

namespace nephroid {

/// Decisions of a camera path that have dimensions of the sequence beside a light path, and those
/// of the light path. Two scrambles of one dimension are functions of each other: the paths of a
/// pair, which follow one index, need dimensions of their own.
inline constexpr int kEyePathDimensions = 96, kLightPathDimensions = 48;
inline constexpr int kPairDimensions = kEyePathDimensions + kLightPathDimensions;

/// The dimension of the Sobol' sequence that decision `d` of a pair has, from 0 up to, but not
/// including, kPairDimensions: first the eye path's (walk.h), then the light path's, whose light,
/// point and direction come before its vertices.
int dimension_of(int d);

/// Point number `index` of a pixel, for its camera path. Decisions from kEyePathDimensions on have
/// their own dimensions, if `dimensions` goes so far, else independent numbers.
SobolPoint eye_point(uint32_t index, int dimensions = kSobolDimensions);

/// The same for the light path beside it, whose numbers begin at kEyePathDimensions.
SobolPoint light_point(uint32_t index);

}  // namespace nephroid
