// Moments of the Fresnel reflectance over a hemisphere, for light inside a medium of index `eta` at
// its boundary with vacuum (eta < 1: light outside a medium of index 1/eta). It must not know
// profiles or lobes. Fits: d'Eon & Irving, A Quantized-Diffusion Model for Rendering Translucent
// Materials, 2011; good to about 1e-3 for eta from 0.5 to 2.
#pragma once

namespace nephroid {

/// Integral of F(cos) cos over cos in [0,1]: half the reflectance for diffuse light.
constexpr double fresnel_moment_1(double eta) {
  const auto p = [eta](double a, double b, double c, double d, double e, double f) {
    return a + eta * (b + eta * (c + eta * (d + eta * (e + eta * f))));
  };
  return eta < 1.0 ? p(0.45966, -1.73965, 3.37668, -3.904945, 2.49277, -0.68441)
                   : p(-4.61686, 11.1136, -10.4646, 5.11455, -1.27198, 0.12746);
}

/// Integral of F(cos) cos^2.
constexpr double fresnel_moment_2(double eta) {
  if (eta < 1.0)
    return 0.27614 +
           eta * (-0.87350 + eta * (1.12077 + eta * (-0.65095 + eta * (0.07883 + eta * 0.04860))));
  const double r = 1.0 / eta;
  return -547.033 + r * (458.843 + r * (-218.725 + r * 45.3087)) +
         eta * (404.557 + eta * (-189.519 + eta * (54.9327 + eta * (-9.00603 + eta * 0.63942))));
}

}  // namespace nephroid
