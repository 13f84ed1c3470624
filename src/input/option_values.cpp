// All parsers use from_chars, which is independent of the locale.
#include "input/option_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/errors.h"

namespace nephroid {
namespace {

constexpr int kLargestSide = 65536;

[[noreturn]] void fail(const std::string& option, const std::string& text,
                       const std::string& expected) {
  throw UsageError(fmt::format("{}: '{}' is not valid, expected {}", option, text, expected));
}

/// The whole text as a number; empty if it is anything else.
template <class T>
std::optional<T> number_of(const std::string& text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

int64_t parse_integer(const std::string& option, const std::string& text, int64_t low,
                      int64_t high) {
  const auto value = number_of<int64_t>(text);
  if (value && *value >= low && *value <= high) return *value;
  fail(option, text,
       high == std::numeric_limits<int64_t>::max()
           ? fmt::format("a whole number from {}", low)
           : fmt::format("a whole number from {} to {}", low, high));
}

uint64_t parse_seed(const std::string& option, const std::string& text) {
  const auto value = number_of<uint64_t>(text);
  if (!value) fail(option, text, "a whole number from 0 to 18446744073709551615");
  return *value;
}

int parse_int(const std::string& option, const std::string& text, int low, int high) {
  return static_cast<int>(parse_integer(option, text, low, high));
}

bool parse_yes_no(const std::string& option, const std::string& text) {
  if (text != "yes" && text != "no") fail(option, text, "yes or no");
  return text == "yes";
}

std::string yes_no_text(bool yes) {
  return yes ? "yes" : "no";
}

float parse_float(const std::string& option, const std::string& text, double low, double high,
                  bool low_is_open) {
  return static_cast<float>(parse_number(option, text, low, high, low_is_open));
}

double parse_number(const std::string& option, const std::string& text, double low, double high,
                    bool low_is_open) {
  const auto value = number_of<double>(text);
  const bool good = value && std::isfinite(*value) && *value <= high &&
                    (low_is_open ? *value > low : *value >= low);
  if (good) return *value;
  std::string expected = fmt::format("a number {} {:g}", low_is_open ? "above" : "from", low);
  if (std::isfinite(high)) expected += fmt::format(" to {:g}", high);
  fail(option, text, expected);
}

std::pair<float, float> parse_range(const std::string& option, const std::string& text, float low,
                                    float high) {
  const size_t dots = text.find("..");
  const auto first = number_of<float>(text.substr(0, dots));
  const auto last = dots == std::string::npos ? first : number_of<float>(text.substr(dots + 2));
  if (first && last && *first >= low && *last >= *first && *last <= high) return {*first, *last};
  fail(option, text,
       fmt::format("a number from {:g} to {:g}, or a range of them as in {:g}..{:g}", low, high,
                   low, high));
}

int64_t parse_bytes(const std::string& option, const std::string& text) {
  constexpr double kMaxBytes = double(int64_t{1} << 40);
  const size_t unit = text.empty() ? std::string::npos : std::string("KMG").find(text.back());
  const auto number =
      number_of<double>(unit == std::string::npos ? text : text.substr(0, text.size() - 1));
  const double factor = unit == std::string::npos ? 1.0 : std::ldexp(1.0, 10 * (int(unit) + 1));
  if (number && *number >= 0 && *number * factor <= kMaxBytes)
    return static_cast<int64_t>(*number * factor);
  fail(option, text, "a number of bytes from 0 to 1024G, such as 4096, 64K, 512M or 1.5G");
}

std::string bytes_text(int64_t bytes) {
  size_t unit = 0;
  while (unit < 3 && bytes != 0 && bytes % 1024 == 0) {
    bytes /= 1024;
    ++unit;
  }
  constexpr const char* kUnits[] = {"", "K", "M", "G"};
  return fmt::format("{}{}", bytes, kUnits[unit]);
}

double parse_duration(const std::string& option, const std::string& text) {
  double unit = 1;
  std::string number = text;
  if (!text.empty()) {
    const char last = text.back();
    if (last == 's' || last == 'm' || last == 'h') number.pop_back();
    if (last == 'm') unit = 60;
    if (last == 'h') unit = 3600;
  }
  const auto value = number_of<double>(number);
  if (!value || !std::isfinite(*value) || *value <= 0)
    fail(option, text, "a duration above 0 as in 60s, 5m or 1h");
  return *value * unit;
}

double parse_seconds(const std::string& option, const std::string& text, double high) {
  std::string number = text;
  if (!number.empty() && number.back() == 's') number.pop_back();
  const size_t slash = number.find('/');
  auto value = number_of<double>(number.substr(0, slash));
  if (value && slash != std::string::npos) {
    const auto divisor = number_of<double>(number.substr(slash + 1));
    if (divisor && *divisor > 0)
      *value /= *divisor;
    else
      value.reset();
  }
  if (value && *value >= 0 && *value <= high) return *value;
  fail(option, text, fmt::format("seconds from 0 to {:g} as in 0.5, 0.5s or 1/48s", high));
}

std::pair<uint32_t, uint32_t> parse_passes(const std::string& option, const std::string& text) {
  const char* expected = "a number of passes N, or a range A..B from 0, both ends included";
  // The last value is not used: passes are counted in 32 bits.
  constexpr uint32_t kMaxPasses = std::numeric_limits<uint32_t>::max() - 1;
  const size_t dots = text.find("..");
  if (dots == std::string::npos) {
    const auto count = number_of<uint32_t>(text);
    if (!count || *count == 0 || *count > kMaxPasses) fail(option, text, expected);
    return {0, *count - 1};
  }
  const auto first = number_of<uint32_t>(text.substr(0, dots));
  const auto last = number_of<uint32_t>(text.substr(dots + 2));
  if (!first || !last || *first > *last || *last >= kMaxPasses) fail(option, text, expected);
  return {*first, *last};
}

std::pair<int, int> parse_resolution(const std::string& option, const std::string& text) {
  const size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = number_of<int>(text.substr(0, cross));
    const auto height = number_of<int>(text.substr(cross + 1));
    const auto good = [](const std::optional<int>& side) {
      return side && *side >= 1 && *side <= kLargestSide;
    };
    if (good(width) && good(height)) return {*width, *height};
  }
  fail(option, text, fmt::format("WIDTHxHEIGHT, each from 1 to {}", kLargestSide));
}

std::vector<std::string> parse_names(const std::string& option, const std::string& text,
                                     const std::string& example) {
  std::vector<std::string> names;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    if (comma == begin)
      throw UsageError(
          fmt::format("{}: '{}' is not valid, expected names as in {}", option, text, example));
    names.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return names;
}

std::array<float, 4> parse_crop(const std::string& option, const std::string& text) {
  const char* expected = "x0,x1,y0,y1 with 0 <= x0 < x1 <= 1 and 0 <= y0 < y1 <= 1";
  std::array<float, 4> crop{};
  size_t begin = 0;
  for (size_t i = 0; i < 4; ++i) {
    const size_t comma = i < 3 ? text.find(',', begin) : text.size();
    if (comma == std::string::npos) fail(option, text, expected);
    const auto value = number_of<float>(text.substr(begin, comma - begin));
    if (!value || !(*value >= 0 && *value <= 1)) fail(option, text, expected);
    crop[i] = *value;
    begin = comma + 1;
  }
  if (!(crop[0] < crop[1] && crop[2] < crop[3])) fail(option, text, expected);
  return crop;
}

}  // namespace nephroid
