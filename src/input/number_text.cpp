// Parses with std::from_chars; values out of range become infinity or zero.
#include "input/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace nephroid {
namespace {

/// Removes a leading plus, which std::from_chars refuses; "+-1" is still not a number.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  return text;
}

/// The nearest double, infinity or zero, of a number that is too large or too small for one. For
/// such a number std::from_chars gives an error and no value.
double nearest_double(std::string_view text) {
  const size_t e = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, e);
  long long exponent = 0;
  if (e < text.size()) {
    const std::string_view power = without_plus(text.substr(e + 1));
    const auto result = std::from_chars(power.data(), power.data() + power.size(), exponent);
    // An exponent of 20 digits outweighs all digits before it.
    if (result.ec == std::errc::result_out_of_range)
      exponent = (power[0] == '-' ? -1 : 1) * (std::numeric_limits<long long>::max() / 2);
  }
  const auto place = [](size_t i) { return static_cast<long long>(i); };
  const long long above_point =
      place(std::min(digits.find('.'), digits.size())) - place(digits.find_first_of("123456789"));
  const double size = exponent + above_point > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return text[0] == '-' ? -size : size;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  double value = 0;
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc::invalid_argument || result.ptr != end) return std::nullopt;
  return result.ec == std::errc() ? value : nearest_double(text);
}

std::optional<long long> parse_integer(std::string_view text) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  long long value = 0;
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

}  // namespace nephroid
