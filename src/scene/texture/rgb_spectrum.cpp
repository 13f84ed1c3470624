#include "scene/texture/rgb_spectrum.h"

#include <string_view>

namespace nephroid {

Rgb read_factor(const ParameterSet& parameters) {
  const Parameter* p = parameters.find("factor");
  if (!p) return {1, 1, 1};
  if (p->type != "rgb" || p->numbers.size() != 3)
    throw SceneError(p->where,
                     "\"factor\" is not an rgb colour, expected \"rgb factor\" [ r g b ]");
  const Rgb c{static_cast<float>(p->numbers[0]), static_cast<float>(p->numbers[1]),
              static_cast<float>(p->numbers[2])};
  for (int i = 0; i < 3; ++i)
    if (!(c[i] >= 0.0f) || !std::isfinite(c[i]))
      throw SceneError(p->where, "\"factor\" is negative or not finite, expected a colour");
  return c;
}

std::optional<int> read_channel(const ParameterSet& parameters) {
  const std::string name = parameters.get_string("channel", "");
  if (name.empty()) return std::nullopt;
  constexpr std::string_view kChannels = "rgba";
  const size_t index = name.size() == 1 ? kChannels.find(name[0]) : std::string_view::npos;
  if (index == std::string_view::npos)
    throw SceneError(parameters.find("channel")->where,
                     "unknown channel \"" + name + "\", expected \"r\", \"g\", \"b\" or \"a\"");
  return static_cast<int>(index);
}

std::optional<float> read_cutoff(const ParameterSet& parameters) {
  if (!parameters.find("cutoff")) return std::nullopt;
  return parameters.get_float("cutoff", 0.0f);
}

}  // namespace nephroid
