#include "input/staging/preetham_sky.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;
/// Illuminance of the sun above the air, lux (IES Lighting Handbook).
constexpr double kSolarIlluminance = 127500;
constexpr double kSunTemperature = 5778;  ///< K

/// A polynomial of the sun's zenith angle and the turbidity T: rows for T^2, T and 1, columns for
/// the angle's powers 3 to 0.
double zenith_chromaticity(const double (&m)[3][4], double angle, double turbidity) {
  const double t[3] = {turbidity * turbidity, turbidity, 1};
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += t[i] * (((m[i][0] * angle + m[i][1]) * angle + m[i][2]) * angle + m[i][3]);
  return sum;
}

constexpr double kZenithX[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                   {-0.02903, 0.06377, -0.03202, 0.00394},
                                   {0.11693, -0.21196, 0.06052, 0.25886}};
constexpr double kZenithY[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                   {-0.04214, 0.08970, -0.04153, 0.00516},
                                   {0.15346, -0.26756, 0.06670, 0.26688}};

/// Relative radiance of a black body (Planck) at a wavelength in nm.
double black_body(double nm, double kelvin) {
  constexpr double kSecondConstant = 1.438776877e7;  // nm K
  return std::pow(nm / 555, -5) / std::expm1(kSecondConstant / (nm * kelvin));
}

}  // namespace

double PreethamSky::Perez::operator()(double cos_zenith, double to_sun) const {
  const double cosine = std::max(cos_zenith, 1e-3);  // the horizon is at infinity
  const double cos_sun = std::cos(to_sun);
  return (1 + a * std::exp(b / cosine)) * (1 + c * std::exp(d * to_sun) + e * cos_sun * cos_sun);
}

PreethamSky::PreethamSky(const Vec3d& to_sun, double t) : to_sun_(to_sun) {
  const double cos_sun = std::clamp(to_sun.z, 0.0, 1.0);
  const double angle = std::acos(cos_sun);
  const double chi = (4.0 / 9 - t / 120) * (kPiDouble - 2 * angle);
  const double kilo_luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  luminance_ = {{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                 0.1206 * t - 2.5771, -0.0670 * t + 0.3703},
                1000 * std::max(kilo_luminance, 0.0)};
  x_ = {{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
         -0.0033 * t + 0.0452},
        zenith_chromaticity(kZenithX, angle, t)};
  y_ = {{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
         -0.0109 * t + 0.0529},
        zenith_chromaticity(kZenithY, angle, t)};
  for (Distribution* quantity : {&luminance_, &x_, &y_})
    quantity->at_zenith = quantity->perez(1, angle);
  find_sun(t);
}

Rgb PreethamSky::luminance(const Vec3d& direction) const {
  const double to_sun = std::acos(std::clamp(direction.dot(to_sun_), -1.0, 1.0));
  const double y = y_(direction.z, to_sun), x = x_(direction.z, to_sun);
  const double luminance = std::max(luminance_(direction.z, to_sun), 0.0);
  const Xyz xyz{static_cast<float>(luminance * x / y), static_cast<float>(luminance),
                static_cast<float>(luminance * (1 - x - y) / y)};
  const Rgb rgb = RgbColorSpace::srgb().from_xyz(xyz);
  return {std::max(rgb.r, 0.0f), std::max(rgb.g, 0.0f), std::max(rgb.b, 0.0f)};
}

void PreethamSky::find_sun(double turbidity) {
  const double degrees = std::acos(std::clamp(to_sun_.z, 0.0, 1.0)) * 180 / kPiDouble;
  const double air_mass =
      1 / (std::max(to_sun_.z, 0.0) + 0.15 * std::pow(93.885 - degrees, -1.253));
  const double haze = 0.04608 * turbidity - 0.04586;
  double above = 0, below = 0;
  for (int nm = 360; nm <= 830; nm += 10) {
    const double micrometres = nm / 1000.0;
    const double optical_depth =
        0.008735 * std::pow(micrometres, -4.08) + haze * std::pow(micrometres, -1.3);
    const double emitted = black_body(nm, kSunTemperature);
    const double arriving = emitted * std::exp(-air_mass * optical_depth);
    const double response = cie_xyz(static_cast<float>(nm)).y;
    above += emitted * response;
    below += arriving * response;
    sun_spectrum_.emplace_back(nm, arriving);
  }
  sun_illuminance_ = kSolarIlluminance * below / above;
}

}  // namespace nephroid
