#include "input/sky/hosek_wilkie_sky.h"

#include <algorithm>
#include <cmath>

#include "input/sky/hosek_wilkie_data.h"

namespace nephroid {
namespace {

constexpr int kTurbidities = 10, kNodes = 6;

/// Weights of the Bernstein polynomials of degree five.
struct Bernstein {
  double weights[kNodes];
  explicit Bernstein(double t) {
    constexpr double kBinomials[kNodes] = {1, 5, 10, 10, 5, 1};
    for (int i = 0; i < kNodes; ++i)
      weights[i] = kBinomials[i] * std::pow(1 - t, 5 - i) * std::pow(t, i);
  }
};

/// A coefficient, one of `count` per node, interpolated in elevation, turbidity and albedo.
double coefficient(const float* data, int count, int index, double turbidity, double albedo,
                   const Bernstein& elevation) {
  const int low = std::min(static_cast<int>(turbidity), kTurbidities - 1);
  double sum = 0;
  for (int bright = 0; bright < 2; ++bright)
    for (int step = 0; step < 2; ++step) {
      const double share = step == 1 ? turbidity - low : 1 - (turbidity - low);
      const float* nodes = data + ((bright * kTurbidities + low - 1 + step) * kNodes) * count;
      double value = 0;
      for (int i = 0; i < kNodes; ++i) value += elevation.weights[i] * nodes[i * count + index];
      sum += share * (bright == 1 ? albedo : 1 - albedo) * value;
    }
  return sum;
}

}  // namespace

HosekWilkieSky::HosekWilkieSky(double turbidity, const Vec3d& albedo, double elevation) {
  constexpr double kHalfPi = 1.57079632679489661923;
  const Bernstein weights(std::cbrt(std::clamp(elevation / kHalfPi, 0.0, 1.0)));
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 9; ++i)
      channels_[c].shape[i] =
          coefficient(kHosekWilkieShape[c], 9, i, turbidity, albedo[c], weights);
    channels_[c].radiance =
        coefficient(kHosekWilkieRadiance[c], 1, 0, turbidity, albedo[c], weights);
  }
}

Rgb HosekWilkieSky::radiance(double theta, double gamma) const {
  const double cos_theta = std::max(0.0, std::cos(theta)), cos_gamma = std::cos(gamma);
  float rgb[3];
  for (int c = 0; c < 3; ++c) {
    // Equations 8 and 9 of the paper; the letters are those of its coefficients.
    const double* s = channels_[c].shape;
    const double g = s[8];
    const double chi = (1 + cos_gamma * cos_gamma) / std::pow(1 + g * g - 2 * g * cos_gamma, 1.5);
    const double f = (1 + s[0] * std::exp(s[1] / (cos_theta + 0.01))) *
                     (s[2] + s[3] * std::exp(s[4] * gamma) + s[5] * cos_gamma * cos_gamma +
                      s[6] * chi + s[7] * std::sqrt(cos_theta));
    // The data are integrals over the matching curves, so that a radiance of 1 W / (m^2 sr nm) at
    // all wavelengths is kCieYIntegral.
    rgb[c] = static_cast<float>(std::max(0.0, f * channels_[c].radiance / kCieYIntegral));
  }
  return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace nephroid
