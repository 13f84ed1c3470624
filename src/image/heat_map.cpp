// The false colours of compare.h, made in CIE L*a*b*. Lightness rises evenly from almost black to
// almost white while the hue turns from violet over red to yellow. So the order of errors is
// visible without a legend and in black and white.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math.h"
#include "image/compare.h"

namespace nephroid {
namespace {

struct LinearRgb {
  double r = 0, g = 0, b = 0;
  bool in_gamut() const { return std::min({r, g, b}) >= 0 && std::max({r, g, b}) <= 1; }
};

double lab_inverse(double t) {
  return t > 6.0 / 29 ? t * t * t : 3 * sqr(6.0 / 29) * (t - 4.0 / 29);
}

/// CIE L*a*b* (white point D65) to linear sRGB.
LinearRgb from_lab(double lightness, double a, double b) {
  const double fy = (lightness + 16) / 116;
  const double x = 0.95047 * lab_inverse(fy + a / 500);
  const double y = lab_inverse(fy);
  const double z = 1.08883 * lab_inverse(fy - b / 200);
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
          -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

/// Colour at t in [0,1]. Chroma is reduced until the colour is in gamut; its lightness is kept.
LinearRgb ramp(double t) {
  const double lightness = 4 + 92 * t;
  const double hue = (300 + 165 * t) * double{kPi} / 180;
  for (double chroma = 70; chroma > 0; chroma -= 1) {
    const LinearRgb color = from_lab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
    if (color.in_gamut()) return color;
  }
  return from_lab(lightness, 0, 0);
}

constexpr size_t kRampSteps = 1024;

uint8_t encode(double linear) {
  return encode_srgb8(static_cast<float>(linear));
}

std::vector<HeatColor> make_colors() {
  std::vector<HeatColor> colors(kRampSteps);
  for (size_t i = 0; i < kRampSteps; ++i) {
    const LinearRgb color = ramp(static_cast<double>(i) / (kRampSteps - 1));
    colors[i] = {encode(color.r), encode(color.g), encode(color.b)};
  }
  return colors;
}

}  // namespace

HeatColor heat_color(double squared_relative_error) {
  // The search for colours in gamut is slow, so it is done once.
  static const std::vector<HeatColor> colors = make_colors();
  const double clamped = std::clamp(squared_relative_error, kHeatMin, kHeatMax);
  const double t = std::log(clamped / kHeatMin) / std::log(kHeatMax / kHeatMin);
  return colors[static_cast<size_t>(std::lround(t * (kRampSteps - 1)))];
}

std::vector<uint8_t> heat_map(const Picture& reference, const Picture& test) {
  const std::vector<double> errors = relative_squared_errors(reference, test);
  std::vector<uint8_t> bytes;
  bytes.reserve(errors.size() * 3);
  for (const double error : errors) {
    const HeatColor color = heat_color(error);
    bytes.insert(bytes.end(), {color.r, color.g, color.b});
  }
  return bytes;
}

void write_heat_map(const std::string& path, const Picture& reference, const Picture& test) {
  write_png(path, reference.width(), reference.height(), heat_map(reference, test));
}

std::string heat_map_legend() {
  std::string text = "squared relative error in the heat map:\n";
  const int first = static_cast<int>(std::lround(std::log10(kHeatMin)));
  const int last = static_cast<int>(std::lround(std::log10(kHeatMax)));
  for (int decade = first; decade <= last; ++decade) {
    const double error = std::pow(10.0, decade);
    const HeatColor color = heat_color(error);
    const char* bound = decade == first ? " or less" : decade == last ? " or more" : "";
    text += fmt::format("  #{:02x}{:02x}{:02x}  {:g}{}\n", color.r, color.g, color.b, error, bound);
  }
  return text;
}

}  // namespace nephroid
