#include "session/report/short_number.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

namespace nephroid {
namespace {

std::string in_units(double value, double step, std::span<const char* const> units) {
  size_t unit = 0;
  for (; std::abs(value) >= 999.5 && unit + 1 < units.size(); ++unit) value /= step;
  // The largest unit takes whatever is left, without an exponent.
  return std::abs(value) >= 999.5 ? fmt::format("{:.0f}{}", value, units[unit])
                                  : fmt::format("{:.3g}{}", value, units[unit]);
}

}  // namespace

std::string short_number(double value) {
  constexpr const char* kUnits[] = {"", " k", " M", " G", " T"};
  return in_units(value, 1000, kUnits);
}

std::string short_count(double count, const std::string& noun) {
  const std::string number = short_number(count);
  return number + " " + noun + (number == "1" ? "" : "s");
}

std::string short_bytes(double bytes) {
  constexpr const char* kUnits[] = {" B", " KiB", " MiB", " GiB", " TiB"};
  return in_units(bytes, 1024, kUnits);
}

}  // namespace nephroid
