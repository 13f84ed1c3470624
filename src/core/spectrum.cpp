// Samples the wavelengths of a path. The density 1/cosh^2 is close to the eye's sensitivity and has
// a closed-form inverse cumulative distribution (Radziszewski et al. 2009; constants of pbrt-v4
// section 4.5.4). It must not know what the wavelengths are used for.
#include "core/spectrum.h"

#include <cmath>

namespace nephroid {
namespace {

constexpr float kPeak = 538.0f;                // nm
constexpr float kWidth = 138.888889f;          // nm
constexpr float kPeakDensity = 0.0039398042f;  // 1/nm
constexpr float kTanhAtMin = 0.85691062f;      // tanh((kPeak - kLambdaMin) / kWidth)
constexpr float kTanhRange = 1.82750197f;      // from there to kLambdaMax

}  // namespace

SampledWavelengths SampledWavelengths::sample_visible(float u) {
  SampledWavelengths s;
  for (int i = 0; i < kSpectrumSamples; ++i) {
    float ui = u + static_cast<float>(i) * (1.0f / kSpectrumSamples);
    if (ui >= 1.0f) ui -= 1.0f;
    // With x = tanh((kPeak - lambda) / kWidth) the density 1/cosh^2 is 1 - x^2.
    const float x = kTanhAtMin - kTanhRange * ui;
    const float atanh_x = 0.5f * std::log((1.0f + x) / (1.0f - x));
    s.lambda_.set(i, std::min(std::max(kPeak - kWidth * atanh_x, kLambdaMin), kLambdaMax));
    s.pdf_.set(i, kPeakDensity * (1.0f - x * x));
  }
  return s;
}

float SampledWavelengths::visible_pdf(float lambda) {
  if (!(lambda >= kLambdaMin && lambda <= kLambdaMax)) return 0.0f;
  const float c = std::cosh((lambda - kPeak) / kWidth);
  return kPeakDensity / (c * c);
}

void SampledWavelengths::terminate_secondary() {
  if (secondary_terminated()) return;
  const float hero = pdf_[hero_] / kSpectrumSamples;
  pdf_ = SampledSpectrum();
  pdf_.set(hero_, hero);
  left_ = hero_;
}

}  // namespace nephroid
