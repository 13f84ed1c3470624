// Radiance of a clear sky. L. Hosek, A. Wilkie, "An Analytic Model for Full Spectral Sky-Dome
// Radiance", SIGGRAPH 2012. It must not know images and lights.
#pragma once

#include "core/color.h"
#include "core/math.h"

namespace nephroid {

class HosekWilkieSky {
 public:
  /// `turbidity` from 1 to 10, `albedo` of the ground from 0 to 1, `elevation` of the sun from 0 to
  /// pi / 2.
  HosekWilkieSky(double turbidity, const Vec3d& albedo, double elevation);

  /// Linear sRGB in W / (m^2 sr nm), at the zenith angle `theta`, below pi / 2, and the angle
  /// `gamma` to the sun.
  Rgb radiance(double theta, double gamma) const;

 private:
  struct Channel {
    double shape[9] = {};
    double radiance = 0;
  };
  Channel channels_[3];
};

}  // namespace nephroid
