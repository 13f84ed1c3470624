// A spectrum with one value per nanometre, looked up at the nearest one as in pbrt-v4's lights: no
// interpolation and no search. It must not know where the values come from.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/color_fit.h"
#include "core/spectra.h"

namespace nephroid {

/// Index of the nanometre nearest to `lambda`, which must lie in [kLambdaMin, kLambdaMax].
inline int nearest_node(float lambda) {
  return static_cast<int>(lambda - kLambdaMin + 0.5f);
}

class DenseSpectrum final : public Spectrum {
 public:
  /// kTableNodes values, for 360, 361, ..., 830 nm.
  explicit DenseSpectrum(std::span<const float> values) {
    std::copy(values.begin(), values.end(), values_.begin());
  }

  float operator()(float lambda) const override {
    const float position = lambda - kLambdaMin;
    if (!(position >= -0.5f && position < kTableNodes - 0.5f)) return 0.0f;
    return values_[nearest_node(lambda)];
  }
  SampledSpectrum sample(const SampledWavelengths& lambda) const override {
    SampledSpectrum s;
    for (int i = 0; i < kSpectrumSamples; ++i) s.set(i, values_[nearest_node(lambda.lambda(i))]);
    return s;
  }
  float max_value() const override { return *std::max_element(values_.begin(), values_.end()); }

  std::span<const float> values() const { return values_; }

 private:
  std::array<float, kTableNodes> values_;
};

}  // namespace nephroid
