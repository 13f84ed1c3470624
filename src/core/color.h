// Tristimulus colour: XYZ, rgb colour spaces, the coefficients that turn rgb into spectra, and the
// film sensor's response to a sampled spectrum. It must not know pixels or files.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/spectrum.h"

namespace nephroid {

struct Rgb {
  float r = 0, g = 0, b = 0;
  float operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
  Rgb operator+(const Rgb& o) const { return {r + o.r, g + o.g, b + o.b}; }
  Rgb operator*(float c) const { return {r * c, g * c, b * c}; }
  bool is_finite() const { return std::isfinite(r) && std::isfinite(g) && std::isfinite(b); }
};
struct Xyz {
  float x = 0, y = 0, z = 0;
};

/// A linear map of rgb values: rows are the results.
using ColorMatrix = std::array<std::array<float, 3>, 3>;
inline Rgb operator*(const ColorMatrix& m, const Rgb& c) {
  return {m[0][0] * c.r + m[0][1] * c.g + m[0][2] * c.b,
          m[1][0] * c.r + m[1][1] * c.g + m[1][2] * c.b,
          m[2][0] * c.r + m[2][1] * c.g + m[2][2] * c.b};
}

/// Coefficients of s(lambda) = 1/2 + p/(2 sqrt(1+p^2)), p = (c0*lambda + c1)*lambda + c2, with
/// lambda in nm (Jakob & Hanika 2019).
struct SigmoidPolynomial {
  float c0 = 0, c1 = 0, c2 = 0;
  float operator()(float lambda) const;
  SampledSpectrum sample(const SampledWavelengths& lambda) const;
  float max_value() const;
};

class Spectrum;

/// One of pbrt-v4's spaces. Immutable; get one from find(). The coefficient tables are made at
/// first use (thread-safe), except that of sRGB.
class RgbColorSpace {
 public:
  /// "srgb", "dci-p3", "rec2020", "aces2065-1"; nullptr for any other name.
  static const RgbColorSpace* find(std::string_view name);
  static const RgbColorSpace& srgb();

  std::string_view name() const { return name_; }
  Rgb from_xyz(Xyz xyz) const;
  Xyz to_xyz(Rgb rgb) const;
  /// Rows are r, g, b; columns x, y, z.
  const std::array<std::array<float, 3>, 3>& matrix_from_xyz() const { return from_xyz_; }
  /// Coefficients for a reflectance rgb; components are clamped to [0,1].
  SigmoidPolynomial polynomial(Rgb rgb) const;
  /// The standard illuminant whose colour is (1,1,1) here, as pbrt-v4 scales it.
  const Spectrum& illuminant() const;
  /// Matching curves of this space at 360, 361, ..., 830 nm: the CIE curves times
  /// matrix_from_xyz().
  std::span<const Rgb> sensor_curves() const;

  struct Impl;
  explicit RgbColorSpace(std::unique_ptr<Impl> impl);
  ~RgbColorSpace();

 private:
  std::string_view name_;
  std::array<std::array<float, 3>, 3> from_xyz_{}, to_xyz_{};
  std::unique_ptr<Impl> impl_;
};

/// CIE 1931 matching curves at a wavelength in nm (tables by 1 nm, linear between).
Xyz cie_xyz(float lambda);
inline constexpr float kCieYIntegral = 106.856895f;

/// The film's response to radiance: rgb = sum over wavelengths of L * weight. A weight combines the
/// sensor curve, the wavelength's density, the imaging ratio (exposure time * ISO / 100) and the
/// conversion to the output space. Made once per path or, for photons, once per pass.
struct SensorWeights {
  std::array<SampledSpectrum, 3> rgb;
  Rgb apply(const SampledSpectrum& radiance) const {
    return {(radiance * rgb[0]).sum(), (radiance * rgb[1]).sum(), (radiance * rgb[2]).sum()};
  }
};
/// Weights of the CIE 1931 sensor in `space`, after the white balance `balance` if there is one.
/// Dropped wavelengths have weight 0.
SensorWeights sensor_weights(const SampledWavelengths& lambda, const RgbColorSpace& space,
                             float imaging_ratio,
                             const std::optional<ColorMatrix>& balance = std::nullopt);

}  // namespace nephroid
