// Tables 1 and 2 of the paper (Iqbal, An Introduction to Solar Radiation, 1983).
#include "input/sky/preetham_sun.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/spectra.h"

namespace nephroid {
namespace {

struct Sample {
  double wavelength, value;  ///< nm
};

/// Absorption of ozone, 1/cm.
constexpr Sample kOzone[] = {
    {300, 10},    {305, 4.8},   {310, 2.7},   {315, 1.35},  {320, 0.8},   {325, 0.38},
    {330, 0.16},  {335, 0.075}, {340, 0.04},  {345, 0.019}, {350, 0.007}, {355, 0},
    {445, 0.003}, {450, 0.003}, {455, 0.004}, {460, 0.006}, {465, 0.008}, {470, 0.009},
    {475, 0.012}, {480, 0.014}, {485, 0.017}, {490, 0.021}, {495, 0.025}, {500, 0.03},
    {505, 0.035}, {510, 0.04},  {515, 0.045}, {520, 0.048}, {525, 0.057}, {530, 0.063},
    {535, 0.07},  {540, 0.075}, {545, 0.08},  {550, 0.085}, {555, 0.095}, {560, 0.103},
    {565, 0.11},  {570, 0.12},  {575, 0.122}, {580, 0.12},  {585, 0.118}, {590, 0.115},
    {595, 0.12},  {600, 0.125}, {605, 0.13},  {610, 0.12},  {620, 0.105}, {630, 0.09},
    {640, 0.079}, {650, 0.067}, {660, 0.057}, {670, 0.048}, {680, 0.036}, {690, 0.028},
    {700, 0.023}, {710, 0.018}, {720, 0.014}, {730, 0.011}, {740, 0.01},  {750, 0.009},
    {760, 0.007}, {770, 0.004}, {780, 0},     {790, 0},
};
/// Absorption of mixed gases.
constexpr Sample kGases[] = {
    {759, 0},
    {760, 3},
    {770, 0.21},
    {771, 0},
};
/// Absorption of water vapour, 1/cm.
constexpr Sample kWater[] = {
    {689, 0},      {690, 0.016},  {700, 0.024}, {710, 0.0125}, {720, 1},
    {730, 0.87},   {740, 0.061},  {750, 0.001}, {760, 1e-05},  {770, 1e-05},
    {780, 0.0006}, {790, 0.0175}, {800, 0.036},
};
/// Radiance of the sun above the atmosphere, W / (m^2 sr nm).
constexpr Sample kSun[] = {
    {380, 16559},   {390, 16233.7}, {400, 21127.5}, {410, 25888.2}, {420, 25829.1}, {430, 24232.3},
    {440, 26760.5}, {450, 29658.3}, {460, 30545.4}, {470, 30057.5}, {480, 30663.7}, {490, 28830.4},
    {500, 28712.1}, {510, 27825},   {520, 27100.6}, {530, 27233.6}, {540, 26361.3}, {550, 25503.8},
    {560, 25060.2}, {570, 25311.6}, {580, 25355.9}, {590, 25134.2}, {600, 24631.5}, {610, 24173.2},
    {620, 23685.3}, {630, 23212.1}, {640, 22827.7}, {650, 22339.8}, {660, 21970.2}, {670, 21526.7},
    {680, 21097.9}, {690, 20728.3}, {700, 20240.4}, {710, 19870.8}, {720, 19427.2}, {730, 19072.4},
    {740, 18628.9}, {750, 18259.2},
};

/// Linear between the samples, zero outside.
double value_at(std::span<const Sample> samples, double wavelength) {
  if (wavelength < samples.front().wavelength || wavelength > samples.back().wavelength) return 0;
  size_t i = 1;
  while (i + 1 < samples.size() && samples[i].wavelength < wavelength) ++i;
  const Sample &a = samples[i - 1], &b = samples[i];
  return std::lerp(a.value, b.value, (wavelength - a.wavelength) / (b.wavelength - a.wavelength));
}

/// Transmittance of gases whose absorption saturates.
double saturating(double scale, double inner, double absorption, double path) {
  return std::exp(-scale * absorption * path / std::pow(1 + inner * absorption * path, 0.45));
}

double transmittance(double nm, double air_mass, double turbidity) {
  constexpr double kOzoneColumn = 0.35, kWaterColumn = 2;  // cm
  const double micrometres = nm / 1000;
  const double aerosols = 0.04608365822050 * turbidity - 0.04586025928522;
  const double rayleigh = std::exp(-air_mass * 0.008735 * std::pow(micrometres, -4.08));
  const double haze = std::exp(-air_mass * aerosols * std::pow(micrometres, -1.3));
  const double ozone = std::exp(-air_mass * value_at(kOzone, nm) * kOzoneColumn);
  const double gases = saturating(1.41, 118.93, value_at(kGases, nm), air_mass);
  const double water = saturating(0.2385, 20.07, value_at(kWater, nm), kWaterColumn * air_mass);
  return rayleigh * haze * ozone * gases * water;
}

}  // namespace

Rgb sun_radiance(double zenith, double turbidity) {
  constexpr double kDegrees = 57.295779513082320877;
  const double air_mass =
      1 / (std::cos(zenith) + 0.15 * std::pow(93.885 - zenith * kDegrees, -1.253));
  std::vector<float> wavelengths, values;
  for (int nm = 350; nm <= 800; nm += 5) {
    wavelengths.push_back(static_cast<float>(nm));
    values.push_back(
        static_cast<float>(value_at(kSun, nm) * transmittance(nm, air_mass, turbidity)));
  }
  const Xyz xyz = spectrum_to_xyz(*piecewise_linear_spectrum(wavelengths, values));
  const Rgb rgb = RgbColorSpace::srgb().from_xyz(xyz);
  return {std::max(rgb.r, 0.0f), std::max(rgb.g, 0.0f), std::max(rgb.b, 0.0f)};
}

}  // namespace nephroid
