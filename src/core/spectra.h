// Spectra as functions of wavelength: constants, tables, black bodies, and rgb colours as smooth
// spectra (Jakob & Hanika 2019). Immutable and shared. It must not know files or scenes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/color.h"
#include "core/spectrum.h"

namespace nephroid {

class Spectrum {
 public:
  virtual ~Spectrum() = default;
  /// Value at `lambda` in nm.
  virtual float operator()(float lambda) const = 0;
  /// Values at the wavelengths of a path.
  virtual SampledSpectrum sample(const SampledWavelengths& lambda) const = 0;
  /// An upper bound of the value over [kLambdaMin, kLambdaMax].
  virtual float max_value() const = 0;
  /// True if the value is the same at every wavelength.
  virtual bool is_constant() const { return false; }
  /// The spectrum that spectrum_to_photometric measures: this one or, for an rgb emission, the
  /// illuminant of its colour space, so that scaling by it keeps the rgb value.
  virtual const Spectrum& photometric_reference() const { return *this; }
};
using SpectrumPtr = std::shared_ptr<const Spectrum>;

SpectrumPtr constant_spectrum(float value);
/// Linear between the points (lambda ascending, nm), zero outside, as pbrt-v4 does.
SpectrumPtr piecewise_linear_spectrum(std::vector<float> lambda, std::vector<float> value);
/// Planck's law at `kelvin`, scaled so that its maximum is 1.
/// Black (0 everywhere) unless `kelvin` is positive.
SpectrumPtr blackbody_spectrum(float kelvin);
/// blackbody_spectrum(kelvin) at the wavelengths of a path, for temperatures that vary in a medium.
SampledSpectrum sample_blackbody(float kelvin, const SampledWavelengths& lambda);
/// CIE daylight of a correlated colour temperature, or a black body below 4000 K, where the series
/// is not defined. The scale is arbitrary.
SpectrumPtr daylight_spectrum(float kelvin);

/// Reflectance of an rgb colour; components are clamped to [0,1].
SpectrumPtr rgb_albedo_spectrum(const RgbColorSpace& space, Rgb rgb);
/// Any non-negative rgb quantity: a scaled reflectance.
SpectrumPtr rgb_unbounded_spectrum(const RgbColorSpace& space, Rgb rgb);
/// Emission of an rgb colour: rgb_unbounded times the white point's illuminant of the space.
SpectrumPtr rgb_illuminant_spectrum(const RgbColorSpace& space, Rgb rgb);

/// A measured spectrum by pbrt-v4's name ("metal-Ag-eta", "metal-Ag-k", "glass-BK7",
/// "stdillum-D65", "illum-acesD60"); nullptr if there is none.
SpectrumPtr named_spectrum(std::string_view name);
/// All names that named_spectrum knows, sorted.
std::vector<std::string> named_spectra();

/// Integral of photometric_reference() times the CIE y-bar curve over wavelength (nm), not
/// normalised. Emission divided by it has luminance 1 (pbrt-v4's SpectrumToPhotometric).
float spectrum_to_photometric(const Spectrum& s);
/// XYZ of `s` normalised so that the equal-energy spectrum of value 1 has Y = 1.
Xyz spectrum_to_xyz(const Spectrum& s);

}  // namespace nephroid
