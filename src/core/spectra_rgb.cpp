// Spectra of rgb colours: reflectances, scaled reflectances and emissions. Grey colours are
// constant and need no polynomial. It must not know how the coefficients were found.
#include <algorithm>
#include <memory>
#include <utility>

#include "core/color.h"
#include "core/spectra.h"

namespace nephroid {
namespace {

class ScaledSigmoidSpectrum final : public Spectrum {
 public:
  ScaledSigmoidSpectrum(float scale, SigmoidPolynomial polynomial)
      : scale_(scale), polynomial_(polynomial) {}
  float operator()(float lambda) const override { return scale_ * polynomial_(lambda); }
  SampledSpectrum sample(const SampledWavelengths& lambda) const override {
    return polynomial_.sample(lambda) * scale_;
  }
  float max_value() const override { return scale_ * polynomial_.max_value(); }

 private:
  float scale_;
  SigmoidPolynomial polynomial_;
};

/// A scaled reflectance times the illuminant of a colour space, which has static lifetime.
class EmissionSpectrum final : public Spectrum {
 public:
  EmissionSpectrum(SpectrumPtr reflectance, const Spectrum& illuminant)
      : reflectance_(std::move(reflectance)), illuminant_(illuminant) {}
  float operator()(float lambda) const override {
    return (*reflectance_)(lambda)*illuminant_(lambda);
  }
  SampledSpectrum sample(const SampledWavelengths& lambda) const override {
    return reflectance_->sample(lambda) * illuminant_.sample(lambda);
  }
  float max_value() const override { return reflectance_->max_value() * illuminant_.max_value(); }
  const Spectrum& photometric_reference() const override { return illuminant_; }

 private:
  SpectrumPtr reflectance_;
  const Spectrum& illuminant_;
};

bool is_grey(const Rgb& c) {
  return c.r == c.g && c.g == c.b;
}

}  // namespace

SpectrumPtr rgb_albedo_spectrum(const RgbColorSpace& space, Rgb rgb) {
  if (is_grey(rgb)) return constant_spectrum(std::clamp(rgb.r, 0.0f, 1.0f));
  return std::make_shared<ScaledSigmoidSpectrum>(1.0f, space.polynomial(rgb));
}

SpectrumPtr rgb_unbounded_spectrum(const RgbColorSpace& space, Rgb rgb) {
  const float most = std::max({rgb.r, rgb.g, rgb.b});
  if (!(most > 0.0f)) return constant_spectrum(0.0f);
  if (is_grey(rgb)) return constant_spectrum(most);
  // Half of the range of reflectances leaves the polynomial room to be smooth.
  const float scale = 2.0f * most;
  return std::make_shared<ScaledSigmoidSpectrum>(scale, space.polynomial(rgb * (1.0f / scale)));
}

SpectrumPtr rgb_illuminant_spectrum(const RgbColorSpace& space, Rgb rgb) {
  return std::make_shared<EmissionSpectrum>(rgb_unbounded_spectrum(space, rgb), space.illuminant());
}

}  // namespace nephroid
