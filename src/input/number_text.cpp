// Numbers from text by way of fast_float and std::from_chars. Called through number_text.h.
#include "input/number_text.h"

#include <fast_float/fast_float.h>

#include <charconv>
#include <system_error>

namespace nephroid {
namespace {

/// Neither library takes a leading plus; "+-1" is still no number.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  return text;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  double value = 0;
  const fast_float::from_chars_result result = fast_float::from_chars(text.data(), end, value);
  // Out of range still sets the value: zero or infinity.
  if (result.ec == std::errc::invalid_argument || result.ptr != end) return std::nullopt;
  return value;
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
