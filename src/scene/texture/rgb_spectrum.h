// What textures with rgb values share: the spectrum of a colour, and the parameters "factor",
// "channel" and "cutoff". It must not know where the colours come from.
#pragma once

#include <algorithm>
#include <optional>

#include "core/color.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// The spectrum of a colour without negative components.
inline SampledSpectrum spectrum_of(const Rgb& c, const RgbColorSpace& space, SpectrumKind kind,
                                   const SampledWavelengths& lambda) {
  if (kind == SpectrumKind::kAlbedo) return space.polynomial(c).sample(lambda);
  // An unbounded colour is represented as a reflectance of at most 1/2 times a scale.
  const float scale = 2.0f * std::max({c.r, c.g, c.b});
  if (!(scale > 0.0f)) return SampledSpectrum();
  const SampledSpectrum s = space.polynomial(c * (1.0f / scale)).sample(lambda) * scale;
  return kind == SpectrumKind::kUnbounded ? s : s * space.illuminant().sample(lambda);
}

inline Rgb product(const Rgb& a, const Rgb& b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

/// 0 below the cutoff and 1 from it on; the value itself without one.
inline float after_cutoff(float value, std::optional<float> cutoff) {
  if (!cutoff) return value;
  return value >= *cutoff ? 1.0f : 0.0f;
}

/// The colour "rgb factor" of the parameters, white by default. Throws SceneError if it is
/// negative.
Rgb read_factor(const ParameterSet& parameters);
/// The number of "string channel": 0 to 3 for "r" to "a"; empty if absent.
std::optional<int> read_channel(const ParameterSet& parameters);
/// "float cutoff"; empty if absent.
std::optional<float> read_cutoff(const ParameterSet& parameters);

}  // namespace nephroid
