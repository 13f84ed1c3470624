// Tables of emission, see emission_spectrum.h.
#include "scene/light/emission_spectrum.h"

namespace nephroid {

EmissionSpectrum::EmissionSpectrum(const Spectrum& spectrum, float scale) {
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < kNodes; ++i) {
    const float lambda = kLambdaMin + static_cast<float>(i);
    values_[i] = scale * spectrum(lambda);
    const double weight = SampledWavelengths::visible_pdf(lambda);
    sum += weight * values_[i];
    weights += weight;
  }
  mean_ = static_cast<float>(sum / weights);
}

RgbEmission::RgbEmission(const RgbColorSpace& space, Rgb rgb) {
  const Rgb c{std::max(0.0f, rgb.r), std::max(0.0f, rgb.g), std::max(0.0f, rgb.b)};
  scale = 2.0f * std::max({c.r, c.g, c.b});
  if (scale > 0.0f) shape = space.polynomial(c * (1.0f / scale));
}

}  // namespace nephroid
