// Daylight of a clear sky. A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for
// Daylight", SIGGRAPH 1999: luminance and colour of the sky (appendix A.2), and the transmittance
// of the air for the sun, of which Rayleigh scattering and haze are taken (appendix A.1). It must
// not know images and lights.
#pragma once

#include <utility>
#include <vector>

#include "core/color.h"
#include "core/math.h"

namespace nephroid {

/// A sky in the frame east, north, up.
class PreethamSky {
 public:
  /// `to_sun` is a unit vector at or above the horizon. `turbidity` is 2 for clear air, 10 for
  /// haze.
  explicit PreethamSky(const Vec3d& to_sun, double turbidity = 3);

  /// Luminance of the sky in a unit direction above the horizon, as linear sRGB in cd/m^2.
  Rgb luminance(const Vec3d& direction) const;
  /// Illuminance of a surface that faces the sun, by the sun alone, in lux.
  double sun_illuminance() const { return sun_illuminance_; }
  /// The sun's light: wavelengths in nm and relative values.
  const std::vector<std::pair<double, double>>& sun_spectrum() const { return sun_spectrum_; }

 private:
  /// Perez's function of zenith angle and angle to the sun, with its five coefficients.
  struct Perez {
    double a, b, c, d, e;
    double operator()(double cos_zenith, double to_sun) const;
  };
  /// A quantity at the zenith, distributed over the sky.
  struct Distribution {
    Perez perez;
    double zenith = 0;
    double at_zenith = 1;  ///< the function at the zenith
    double operator()(double cos_zenith, double to_sun) const {
      return zenith * perez(cos_zenith, to_sun) / at_zenith;
    }
  };
  void find_sun(double turbidity);

  Vec3d to_sun_;
  Distribution luminance_, x_, y_;
  double sun_illuminance_ = 0;
  std::vector<std::pair<double, double>> sun_spectrum_;
};

}  // namespace nephroid
