#include "image/mix_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace nephroid {
namespace {

constexpr const char* kTint = " (tint: an RGB approximation)";

std::optional<KindOfGain> parse_line(const std::string& line) {
  const size_t space = line.find(' '), equals = line.find(" = ");
  if (space == std::string::npos || equals == std::string::npos || equals <= space)
    return std::nullopt;
  KindOfGain gain{line.substr(0, space), {line.substr(space + 1, equals - space - 1), {}}};
  std::istringstream numbers(line.substr(equals + 3));
  float r = 0, g = 0, b = 0;
  char comma = ',';
  if (!(numbers >> r)) return std::nullopt;
  const bool is_tint = static_cast<bool>(numbers >> comma >> g >> comma >> b);
  gain.gain.gain = is_tint ? Rgb{r, g, b} : Rgb{r, r, r};
  return gain;
}

}  // namespace

std::string mix_text(const MixGains& gains) {
  std::string text;
  for (const auto& [kind, gain] : gains) {
    const Rgb& g = gain.gain;
    text += fmt::format("{} {} = {}", kind, gain.name, g.r);
    if (gain.is_tint()) text += fmt::format(", {}, {}{}", g.g, g.b, kTint);
    text += "\n";
  }
  return text;
}

MixGains parse_mix_text(const std::string& text) {
  MixGains gains;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (std::optional<KindOfGain> gain = parse_line(line)) gains.push_back(*std::move(gain));
  return gains;
}

MixGains product(const MixGains& first, const MixGains& second) {
  MixGains gains = first;
  for (const KindOfGain& one : second) {
    const auto earlier = std::ranges::find_if(gains, [&](const KindOfGain& other) {
      return other.kind == one.kind && other.gain.name == one.gain.name;
    });
    if (earlier == gains.end()) {
      gains.push_back(one);
      continue;
    }
    Rgb& g = earlier->gain.gain;
    g = {g.r * one.gain.gain.r, g.g * one.gain.gain.g, g.b * one.gain.gain.b};
  }
  return gains;
}

}  // namespace nephroid
