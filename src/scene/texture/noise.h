// Gradient noise and its sums over octaves. It must not know the textures made from it. Papers:
// Perlin, Improving Noise, SIGGRAPH 2002; Pharr, Jakob & Humphreys, Physically Based Rendering (fBm
// and turbulence with faded octaves, as in pbrt-v4).
#pragma once

#include "core/math.h"
#include "input/scene_description.h"

namespace nephroid {

/// Noise between about -1 and 1, with mean 0, and 0 at all integer lattice points. Its second
/// derivatives are continuous. Period 256 along each axis.
float noise(const Vec3f& p);

/// Octaves with details finer than the footprint of one sample are faded out.
struct NoiseFootprint {
  Vec3f dpdx{0, 0, 0}, dpdy{0, 0, 0};  ///< zero: a point, which resolves all octaves
  NoiseFootprint scaled(float by) const { return {dpdx * by, dpdy * by}; }
};

/// Sum of `octaves` octaves of noise. Each has 1.99 times the frequency and `roughness` times the
/// amplitude of the one before. Mean 0.
float fractal_noise(const Vec3f& p, const NoiseFootprint& footprint, float roughness, int octaves);

/// The same sum of absolute values, not negative. Faded-out octaves count as their mean, 0.2.
float turbulence(const Vec3f& p, const NoiseFootprint& footprint, float roughness, int octaves);

/// Parameters of noise textures: "octaves" and "roughness".
struct NoiseParameters {
  int octaves = 8;
  float roughness = 0.5f;
};

/// Throws SceneError if "octaves" is negative or so large that frequencies overflow.
NoiseParameters read_noise_parameters(const ParameterSet& parameters);

}  // namespace nephroid
