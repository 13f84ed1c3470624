// Sobol' dimensions of a camera path and of the light path connected with it, assigned so that
// decisions that are integrated together are well stratified together (docs/estimators.md, section
// 25). It must not know what the decisions are for.
#pragma once

#include "core/sampler.h"

namespace nephroid {

/// Stratified decisions of a camera path that has a light path beside it, and of that light path.
/// Both follow one index, so each needs its own dimensions: two scrambles of one dimension are
/// functions of each other.
inline constexpr int kEyePathDimensions = 96, kLightPathDimensions = 48;
inline constexpr int kPairDimensions = kEyePathDimensions + kLightPathDimensions;

/// The Sobol' dimension of decision `d` of a pair, 0 <= d < kPairDimensions. The eye path's
/// decisions come first (walk.h), then the light path's: light, point, direction, then its
/// vertices.
int dimension_of(int d);

/// Point `index` of a pixel, for its camera path. Decisions from kEyePathDimensions on keep their
/// own dimensions up to `dimensions`; later ones get independent numbers.
SobolPoint eye_point(uint32_t index, int dimensions = kSobolDimensions);

/// The same for the light path beside it, whose decisions begin at kEyePathDimensions.
SobolPoint light_point(uint32_t index);

}  // namespace nephroid
