// Gradient noise and its sums over octaves. Who calls it: the noise textures, marble and dots of
// this folder. It must not know what they make of it.
// K. Perlin, "Improving Noise", SIGGRAPH 2002; fBm and turbulence with faded octaves as in pbrt-v4
// (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering").
#pragma once

#include "core/math.h"
#include "input/scene_description.h"

namespace nephroid {

/// Between about -1 and 1, with mean 0; 0 at all points of the integer lattice; its second
/// derivatives are continuous. Repeats after 256 along each axis.
float noise(const Vec3f& p);

/// Where an octave's details are finer than what one sample stands for, it is faded out.
struct NoiseFootprint {
  Vec3f dpdx{0, 0, 0}, dpdy{0, 0, 0};  ///< zero: a point, for which all octaves count
  NoiseFootprint scaled(float by) const { return {dpdx * by, dpdy * by}; }
};

/// Sum of `octaves` octaves of noise, each 1.99 times as fine and `roughness` times as strong as
/// the one before. Mean 0.
float fractal_noise(const Vec3f& p, const NoiseFootprint& footprint, float roughness, int octaves);

/// The same sum of absolute values, not negative; octaves that are faded out count as their mean,
/// 0.2.
float turbulence(const Vec3f& p, const NoiseFootprint& footprint, float roughness, int octaves);

/// What noise textures have in common: the parameters "octaves" and "roughness".
struct NoiseParameters {
  int octaves = 8;
  float roughness = 0.5f;
};

/// Throws SceneError if there are fewer octaves than 0 or so many that their frequencies overflow.
NoiseParameters read_noise_parameters(const ParameterSet& parameters);

}  // namespace nephroid
