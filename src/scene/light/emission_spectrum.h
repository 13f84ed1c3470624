// Emission of a light as a table over wavelength: the spectrum of the scene file times all scales.
// It must not know where light goes.
#pragma once

#include <array>

#include "core/color.h"
#include "core/spectra.h"

namespace nephroid {

/// scale * spectrum in steps of 1 nm. A lookup takes the nearest nanometre, as pbrt-v4 does.
class EmissionSpectrum {
 public:
  EmissionSpectrum(const Spectrum& spectrum, float scale);

  SampledSpectrum sample(const SampledWavelengths& lambda) const {
    SampledSpectrum s;
    for (int i = 0; i < kSpectrumSamples; ++i) {
      const int node = static_cast<int>(lambda.lambda(i) - kLambdaMin + 0.5f);
      s.set(i, values_[std::clamp(node, 0, kNodes - 1)]);
    }
    return s;
  }
  /// Mean over wavelengths by their sampling density (SampledWavelengths::visible_pdf).
  float mean() const { return mean_; }

 private:
  static constexpr int kNodes = static_cast<int>(kLambdaMax - kLambdaMin) + 1;
  std::array<float, kNodes> values_;
  float mean_ = 0.0f;
};

/// The emission of an image colour: a polynomial of at most about 1, and a scale. The caller
/// multiplies by the illuminant of the colour space.
struct RgbEmission {
  SigmoidPolynomial shape;
  float scale = 0.0f;

  RgbEmission() = default;
  /// Negative components count as 0.
  RgbEmission(const RgbColorSpace& space, Rgb rgb);
  SampledSpectrum sample(const SampledWavelengths& lambda) const {
    return scale > 0.0f ? shape.sample(lambda) * scale : SampledSpectrum();
  }
};

}  // namespace nephroid
