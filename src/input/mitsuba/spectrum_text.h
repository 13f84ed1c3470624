// Colours and spectra in the attributes of Mitsuba's XML. It must not know what they are for.
#pragma once

#include <string>
#include <vector>

#include "core/math.h"
#include "input/mitsuba/object.h"

namespace nephroid::mitsuba {

/// Linear values of sRGB-coded ones.
Vec3d decoded(const Vec3d& rgb);

/// Linear rgb of "0.1, 0.2, 0.3", "0.5" or "#8040ff". `is_encoded`: numbers are sRGB-coded;
/// hexadecimal colours always are.
Vec3d rgb_of_text(const Property& property, bool is_encoded);

/// Wavelengths in nm and values in turns, of "400:0.1, 700:0.9".
std::vector<double> pairs_of_text(const std::string& text, const SourceLocation& where);

/// The same of a file with a pair in each line; "#" starts a comment.
std::vector<double> pairs_of_file(const std::string& bytes, const SourceLocation& where);

/// Kelvin of "5000K" or "5000".
double kelvin_of_text(const std::string& text, const SourceLocation& where);

/// Luminance of emitted light, as that of the equal-energy spectrum of value 1 is 1.
double luminance_of_pairs(const std::vector<double>& pairs);
/// The same of a black body, by Planck's law in W / (m^2 sr nm).
double luminance_of_black_body(double kelvin);

}  // namespace nephroid::mitsuba
