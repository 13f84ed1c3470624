#include "session/report/short_number.h"

#include <fmt/format.h>

#include <iterator>

namespace nephroid {

std::string short_number(double value) {
  constexpr const char* kUnits[] = {"", "k ", "M ", "G ", "T "};
  size_t unit = 0;
  while (value >= 999.5 && unit + 1 < std::size(kUnits)) {
    value /= 1000;
    ++unit;
  }
  return fmt::format("{:.3g} {}", value, kUnits[unit]);
}

}  // namespace nephroid
