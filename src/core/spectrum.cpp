// Samples the wavelengths of a path. Eight wavelengths at equal steps of the cumulative
// distribution are a quadrature of the film's three curves, so the density decides how much the
// colour of white light varies with their offset. It must not know what the wavelengths are used
// for.
#include "core/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid {
namespace {

/// A normal distribution over [360, 830] nm: peak and standard deviation in nm, share of the whole.
struct Normal {
  double peak, width, share;
};
/// The density is the sum of these and a constant for the rest. A search found the values: over all
/// offsets the colour of white light by day (D65), by a lamp (illuminant A) and of a flat spectrum
/// varies by less than 0.9 % rms, that of density 1/cosh^2 (pbrt-v4 section 4.5.4) by up to 12 %
/// (ADR 46).
constexpr Normal kNormals[] = {{442, 24.7, 0.38}, {510, 24.5, 0.07}, {587, 64, 0.41}};
constexpr int kSteps = 1024;  ///< the distribution is tabulated in so many steps

/// Integral of exp(-((x - peak) / width)^2 / 2) over [a, b], up to a constant factor.
double integral(const Normal& normal, double a, double b) {
  const double scale = std::sqrt(2.0) * normal.width;
  return std::erf((b - normal.peak) / scale) - std::erf((a - normal.peak) / scale);
}

/// Integral of the density from 360 nm to `lambda`.
double cumulative(double lambda) {
  double sum = 0, shares = 0;
  for (const Normal& normal : kNormals) {
    sum += normal.share * integral(normal, kLambdaMin, lambda) /
           integral(normal, kLambdaMin, kLambdaMax);
    shares += normal.share;
  }
  return sum + (1 - shares) * (lambda - kLambdaMin) / (kLambdaMax - kLambdaMin);
}

/// Wavelengths where the cumulative distribution reaches k / kSteps. Between two of them the
/// density is constant, so that samples and densities agree exactly.
using Knots = std::array<float, kSteps + 1>;
Knots make_knots() {
  Knots knots{};
  for (int k = 0; k <= kSteps; ++k) {
    double low = kLambdaMin, high = kLambdaMax;  // bisection
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      (cumulative(middle) * kSteps < k ? low : high) = middle;
    }
    knots[static_cast<size_t>(k)] = static_cast<float>(0.5 * (low + high));
  }
  knots.front() = kLambdaMin;
  knots.back() = kLambdaMax;
  return knots;
}
const Knots& knots() {
  static const Knots kKnots = make_knots();
  return kKnots;
}

float density_in_step(const Knots& at, int step) {
  return 1.0f / (kSteps * (at[static_cast<size_t>(step) + 1] - at[static_cast<size_t>(step)]));
}

}  // namespace

SampledWavelengths SampledWavelengths::sample_visible(float u) {
  const Knots& at = knots();
  SampledWavelengths s;
  for (int i = 0; i < kSpectrumSamples; ++i) {
    float ui = u + static_cast<float>(i) * (1.0f / kSpectrumSamples);
    if (ui >= 1.0f) ui -= 1.0f;
    const float x = ui * kSteps;
    const int step = std::clamp(static_cast<int>(x), 0, kSteps - 1);
    const float begin = at[static_cast<size_t>(step)], end = at[static_cast<size_t>(step) + 1];
    s.lambda_.set(i, std::min(begin + (x - static_cast<float>(step)) * (end - begin), kLambdaMax));
    s.pdf_.set(i, density_in_step(at, step));
  }
  return s;
}

float SampledWavelengths::visible_pdf(float lambda) {
  if (!(lambda >= kLambdaMin && lambda <= kLambdaMax)) return 0.0f;
  const Knots& at = knots();
  const auto next = std::upper_bound(at.begin(), at.end(), lambda);
  return density_in_step(at, std::clamp(static_cast<int>(next - at.begin()) - 1, 0, kSteps - 1));
}

void SampledWavelengths::terminate_secondary() {
  if (secondary_terminated()) return;
  const float hero = pdf_[hero_] / kSpectrumSamples;
  pdf_ = SampledSpectrum();
  pdf_.set(hero_, hero);
  left_ = hero_;
}

}  // namespace nephroid
