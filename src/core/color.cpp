// The matching curves, the sigmoid polynomials and the film sensor. All of it runs at least once
// per path, so the eight wavelengths are processed together. It must not know colour spaces beyond
// their sensor curves.
#include "core/color.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "core/color_fit.h"
#include "core/spectra_data.h"

namespace nephroid {
namespace {

float sigmoid(float p) {
  return 0.5f + p / (2.0f * std::sqrt(1.0f + p * p));
}

struct MatchingCurves {
  std::span<const float> x, y, z;
};

const MatchingCurves& matching_curves() {
  static const MatchingCurves curves = [] {
    const DataTable table = data_table("cie");
    return MatchingCurves{table.column(0), table.column(1), table.column(2)};
  }();
  return curves;
}

/// A wavelength in [kLambdaMin, kLambdaMax] between two nodes of the matching curves.
struct PlaceInCurves {
  int node;  ///< the one below the wavelength
  float t;   ///< 0 there, 1 at the next node
};
PlaceInCurves place_in_curves(float lambda) {
  const float position = lambda - kLambdaMin;
  const int node = std::min(static_cast<int>(position), kTableNodes - 2);
  return {node, position - static_cast<float>(node)};
}

}  // namespace

float SigmoidPolynomial::operator()(float lambda) const {
  return sigmoid((c0 * lambda + c1) * lambda + c2);
}

SampledSpectrum SigmoidPolynomial::sample(const SampledWavelengths& lambda) const {
  const SampledSpectrum::Lanes l = lambda.lambdas().lanes();
  const SampledSpectrum::Lanes p = (c0 * l + c1) * l + c2;
  // Plain arrays, because compilers turn a loop over one into a single vector square root.
  float values[kSpectrumSamples];
  std::memcpy(values, &p, sizeof values);
  for (float& v : values) v = sigmoid(v);
  SampledSpectrum::Lanes result;
  std::memcpy(&result, values, sizeof result);
  return SampledSpectrum(result);
}

float SigmoidPolynomial::max_value() const {
  float most = std::max((*this)(kLambdaMin), (*this)(kLambdaMax));
  const float extremum = -c1 / (2.0f * c0);
  if (extremum >= kLambdaMin && extremum <= kLambdaMax) most = std::max(most, (*this)(extremum));
  return most;
}

Xyz cie_xyz(float lambda) {
  if (!(lambda >= kLambdaMin && lambda <= kLambdaMax)) return {};
  const MatchingCurves& curves = matching_curves();
  const auto [i, t] = place_in_curves(lambda);
  return {lerp(t, curves.x[i], curves.x[i + 1]), lerp(t, curves.y[i], curves.y[i + 1]),
          lerp(t, curves.z[i], curves.z[i + 1])};
}

SensorWeights sensor_weights(const SampledWavelengths& lambda, const RgbColorSpace& space,
                             float imaging_ratio, const std::optional<ColorMatrix>& balance) {
  const std::span<const Rgb> curves = space.sensor_curves();
  const float scale = imaging_ratio / kSpectrumSamples;
  SensorWeights weights;
  for (int i = 0; i < kSpectrumSamples; ++i) {
    const float pdf = lambda.pdf()[i];
    if (pdf == 0.0f) continue;
    // Values of the nearest nanometre would be right on average, but give white light a tint.
    const auto [node, t] = place_in_curves(lambda.lambda(i));
    Rgb at = curves[node] * (1.0f - t) + curves[node + 1] * t;
    if (balance) at = *balance * at;
    const float s = scale / pdf;
    weights.rgb[0].set(i, at.r * s);
    weights.rgb[1].set(i, at.g * s);
    weights.rgb[2].set(i, at.b * s);
  }
  return weights;
}

}  // namespace nephroid
