#include "bench/figure_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace nephroid {

std::string number_text(double value) {
  if (!std::isfinite(value)) return "—";
  if (value < 0) return "−" + number_text(-value);
  if (value >= 1000 && value < 1e6) return fmt::format("{:.0f}", value);
  return fmt::format("{:.3g}", value);
}

std::string count_text(double value) {
  constexpr const char* kUnits[] = {"", " k", " M", " G", " T"};
  size_t unit = 0;
  for (; std::abs(value) >= 999.5 && unit + 1 < std::size(kUnits); ++unit) value /= 1000;
  return fmt::format("{:.3g}{}", value, kUnits[unit]);
}

std::string bytes_in_words(double value) {
  const std::string text = count_text(value);
  return text + (text.find(' ') == std::string::npos ? " B" : "B");
}

std::string seconds_in_words(double seconds) {
  if (!(seconds >= 1)) return number_text(1000 * seconds) + " ms";
  if (seconds < 120) return number_text(seconds) + " s";
  return seconds < 7200 ? number_text(seconds / 60) + " min" : number_text(seconds / 3600) + " h";
}

}  // namespace nephroid
