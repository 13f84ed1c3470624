// Spectra without measured data (constant, piecewise linear, black body), and the integrals that
// give a spectrum its luminance and colour. It must not know colour spaces.
#include "core/spectra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/color_fit.h"

namespace nephroid {
namespace {

class ConstantSpectrum final : public Spectrum {
 public:
  explicit ConstantSpectrum(float value) : value_(value) {}
  float operator()(float) const override { return value_; }
  SampledSpectrum sample(const SampledWavelengths&) const override {
    return SampledSpectrum(value_);
  }
  float max_value() const override { return value_; }
  bool is_constant() const override { return true; }

 private:
  float value_;
};

class PiecewiseLinearSpectrum final : public Spectrum {
 public:
  PiecewiseLinearSpectrum(std::vector<float> lambda, std::vector<float> value)
      : lambda_(std::move(lambda)), value_(std::move(value)) {
    // For every visible nanometre, the last point at or before it (or the first point).
    for (int i = 0; i < kTableNodes; ++i) {
      const float at = kLambdaMin + static_cast<float>(i);
      const auto next = std::upper_bound(lambda_.begin(), lambda_.end(), at);
      const std::ptrdiff_t passed = next - lambda_.begin();
      start_[i] = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(passed, 1) - 1);
    }
  }

  float operator()(float lambda) const override {
    if (lambda_.empty() || !(lambda >= lambda_.front() && lambda <= lambda_.back())) return 0.0f;
    if (lambda == lambda_.back()) return value_.back();
    const float node = std::min(std::max(lambda - kLambdaMin, 0.0f), float(kTableNodes - 1));
    size_t k = lambda < kLambdaMin ? 0 : start_[static_cast<int>(node)];
    while (lambda_[k + 1] <= lambda) ++k;
    const float t = (lambda - lambda_[k]) / (lambda_[k + 1] - lambda_[k]);
    return lerp(t, value_[k], value_[k + 1]);
  }
  SampledSpectrum sample(const SampledWavelengths& lambda) const override {
    SampledSpectrum s;
    for (int i = 0; i < kSpectrumSamples; ++i) s.set(i, (*this)(lambda.lambda(i)));
    return s;
  }
  float max_value() const override {
    float most = std::max((*this)(kLambdaMin), (*this)(kLambdaMax));
    for (size_t i = 0; i < lambda_.size(); ++i)
      if (lambda_[i] >= kLambdaMin && lambda_[i] <= kLambdaMax) most = std::max(most, value_[i]);
    return most;
  }

 private:
  std::vector<float> lambda_, value_;
  std::array<std::uint32_t, kTableNodes> start_{};
};

/// Planck's law relative to its peak: r^5 (e^x - 1) / (e^(x r) - 1), where r = peak wavelength /
/// wavelength and x solves x = 5 (1 - e^-x).
class BlackbodySpectrum final : public Spectrum {
 public:
  explicit BlackbodySpectrum(float kelvin) : peak_(kWien / kelvin) {}

  float operator()(float lambda) const override {
    const float r = peak_ / lambda;
    const float r2 = r * r;
    return r2 * r2 * r * kExpX / std::expm1(kX * r);
  }
  SampledSpectrum sample(const SampledWavelengths& lambda) const override {
    return lambda.lambdas().map([this](float l) { return (*this)(l); });
  }
  float max_value() const override {
    if (peak_ >= kLambdaMin && peak_ <= kLambdaMax) return 1.0f;
    return std::max((*this)(kLambdaMin), (*this)(kLambdaMax));
  }

 private:
  static constexpr float kWien = 2.897771955e6f;  // nm K
  static constexpr float kX = 4.965114232f;
  static constexpr float kExpX = 142.3249216f;  // e^x - 1

  float peak_;  // nm
};

}  // namespace

SpectrumPtr constant_spectrum(float value) {
  return std::make_shared<ConstantSpectrum>(value);
}

SpectrumPtr piecewise_linear_spectrum(std::vector<float> lambda, std::vector<float> value) {
  return std::make_shared<PiecewiseLinearSpectrum>(std::move(lambda), std::move(value));
}

SpectrumPtr blackbody_spectrum(float kelvin) {
  if (!(kelvin > 0.0f)) return constant_spectrum(0.0f);
  return std::make_shared<BlackbodySpectrum>(kelvin);
}

SampledSpectrum sample_blackbody(float kelvin, const SampledWavelengths& lambda) {
  return kelvin > 0.0f ? BlackbodySpectrum(kelvin).sample(lambda) : SampledSpectrum();
}

float spectrum_to_photometric(const Spectrum& s) {
  const Spectrum& light = s.photometric_reference();
  double y = 0;
  for (int i = 0; i < kTableNodes; ++i) {
    const float lambda = kLambdaMin + static_cast<float>(i);
    y += double(light(lambda)) * cie_xyz(lambda).y;
  }
  return static_cast<float>(y);
}

Xyz spectrum_to_xyz(const Spectrum& s) {
  double x = 0, y = 0, z = 0;
  for (int i = 0; i < kTableNodes; ++i) {
    const float lambda = kLambdaMin + static_cast<float>(i);
    const double value = s(lambda);
    const Xyz curve = cie_xyz(lambda);
    x += value * curve.x;
    y += value * curve.y;
    z += value * curve.z;
  }
  const double scale = 1.0 / kCieYIntegral;
  return {static_cast<float>(x * scale), static_cast<float>(y * scale),
          static_cast<float>(z * scale)};
}

}  // namespace nephroid
