#include "bench/figure_text.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid {

std::string number_text(double value) {
  if (!std::isfinite(value)) return "—";
  if (value < 0) return "−" + number_text(-value);
  if (value >= 1000 && value < 1e6) return fmt::format("{:.0f}", value);
  return fmt::format("{:.3g}", value);
}

std::string seconds_in_words(double seconds) {
  if (!(seconds >= 1)) return number_text(1000 * seconds) + " ms";
  if (seconds < 120) return number_text(seconds) + " s";
  return seconds < 7200 ? number_text(seconds / 60) + " min" : number_text(seconds / 3600) + " h";
}

}  // namespace nephroid
