#include "input/mitsuba/spectrum_text.h"

#include <charconv>

#include "core/color.h"
#include "core/counted.h"
#include "core/spectra.h"
#include "core/srgb.h"
#include "input/mitsuba/value_text.h"

namespace nephroid::mitsuba {
namespace {

Vec3d rgb_of_hexadecimal(std::string_view text, const SourceLocation& where) {
  unsigned int value = 0;
  const auto result = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (text.size() != 7 || result.ec != std::errc() || result.ptr != text.data() + text.size())
    throw SceneError(where, "the colour is \"" + std::string(text.substr(0, 40)) +
                                "\", expected \"#\" and six hexadecimal digits");
  return decoded(Vec3d(value >> 16 & 255, value >> 8 & 255, value & 255) / 255.0);
}

void check_pairs(const std::vector<double>& pairs, const SourceLocation& where) {
  if (pairs.size() < 2 || pairs.size() % 2 != 0)
    throw SceneError(where, "a spectrum has " + counted(pairs.size(), "number") +
                                ", expected pairs of a wavelength and a value");
  for (size_t i = 2; i < pairs.size(); i += 2)
    if (!(pairs[i] > pairs[i - 2]))
      throw SceneError(where,
                       "the wavelengths of a spectrum do not increase, expected increasing "
                       "ones");
}

}  // namespace

Vec3d decoded(const Vec3d& v) {
  return {decode_srgb(v.x), decode_srgb(v.y), decode_srgb(v.z)};
}

Vec3d rgb_of_text(const Property& property, bool is_encoded) {
  const std::string text = property.attribute("value");
  const std::string_view word = trimmed(text);
  if (word.starts_with("#")) return rgb_of_hexadecimal(word, property.where);
  const std::string what = "property \"" + property.name + "\"";
  const std::vector<double> v = finite_numbers(text, what, property.where);
  if (v.size() != 1 && v.size() != 3)
    throw SceneError(property.where,
                     what + " has " + std::to_string(v.size()) + " numbers, expected three or one");
  const Vec3d rgb = v.size() == 1 ? Vec3d(v[0]) : Vec3d(v[0], v[1], v[2]);
  return is_encoded ? decoded(rgb) : rgb;
}

std::vector<double> pairs_of_text(const std::string& text, const SourceLocation& where) {
  std::vector<double> pairs;
  for (const std::string_view word : words_of(text)) {
    const size_t colon = word.find(':');
    if (colon == std::string_view::npos)
      throw SceneError(where, "a spectrum has \"" + std::string(word.substr(0, 40)) +
                                  "\", expected WAVELENGTH:VALUE");
    pairs.push_back(finite_number(word.substr(0, colon), "a wavelength", where));
    pairs.push_back(finite_number(word.substr(colon + 1), "a value of a spectrum", where));
  }
  check_pairs(pairs, where);
  return pairs;
}

std::vector<double> pairs_of_file(const std::string& bytes, const SourceLocation& where) {
  std::string text;
  for (size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == '#') i = std::min(bytes.find('\n', i), bytes.size() - 1);
    text += bytes[i];
  }
  std::vector<double> pairs = finite_numbers(text, "a number of the spectrum file", where);
  check_pairs(pairs, where);
  return pairs;
}

double kelvin_of_text(const std::string& text, const SourceLocation& where) {
  std::string_view word = trimmed(text);
  if (!word.empty() && (word.back() == 'K' || word.back() == 'k')) word.remove_suffix(1);
  const double kelvin = finite_number(word, "the temperature", where);
  if (!(kelvin > 0)) throw SceneError(where, "the temperature is not above 0 K, expected kelvin");
  return kelvin;
}

double luminance_of_pairs(const std::vector<double>& pairs) {
  std::vector<float> wavelengths, values;
  for (size_t i = 0; i + 1 < pairs.size(); i += 2) {
    wavelengths.push_back(static_cast<float>(pairs[i]));
    values.push_back(static_cast<float>(pairs[i + 1]));
  }
  return spectrum_to_xyz(*piecewise_linear_spectrum(std::move(wavelengths), std::move(values))).y;
}

double luminance_of_black_body(double kelvin) {
  // First and second radiation constants, for wavelengths in metres.
  constexpr double kFirst = 1.191042972e-16, kSecond = 1.438776877e-2;
  double sum = 0;
  for (int nanometre = 360; nanometre <= 830; ++nanometre) {
    const double l = nanometre * 1e-9;
    const double per_metre = kFirst / (std::pow(l, 5) * std::expm1(kSecond / (l * kelvin)));
    sum += per_metre * 1e-9 * cie_xyz(static_cast<float>(nanometre)).y;
  }
  return sum / kCieYIntegral;
}

}  // namespace nephroid::mitsuba
