// The complex refractive index of a metal, read from the scene: eta and k, or a reflectance at
// normal incidence, reproduced by eta = 1 and k = 2 sqrt(r)/sqrt(1 - r). It must not know
// roughness.
#pragma once

#include "scene/material/inputs.h"

namespace nephroid {

class MetalInput {
 public:
  /// Reads <prefix>eta and <prefix>k, or reflectance; by default copper. Throws SceneError if both
  /// are given.
  MetalInput(const TextureLibrary& textures, const ParameterSet& parameters,
             const std::string& prefix);

  /// The index relative to a medium of index `outside`.
  void at(const SurfaceInteraction& point, const SampledWavelengths& lambda, float outside,
          SampledSpectrum* eta, SampledSpectrum* k) const {
    if (reflectance_.is_set()) {
      // Clamped below 1, so that k stays finite.
      const SampledSpectrum r = clamp(reflectance_.at(point, lambda), 0.0f, 0.9999f);
      *eta = SampledSpectrum(1.0f / outside);
      *k = sqrt(r) / sqrt(SampledSpectrum(1.0f) - r) * (2.0f / outside);
    } else {
      *eta = eta_.at(point, lambda) * (1.0f / outside);
      *k = k_.at(point, lambda) * (1.0f / outside);
    }
  }

 private:
  SpectrumInput eta_, k_, reflectance_;
};

}  // namespace nephroid
