#include "input/parameter_types.h"

#include <algorithm>
#include <array>

namespace nephroid {
namespace {

using Values = ParameterType::Values;

constexpr std::array kParameterTypes = {
    ParameterType{"integer", "integer", Values::kIntegers, 1},
    ParameterType{"float", "float", Values::kNumbers, 1},
    ParameterType{"point2", "point2", Values::kNumbers, 2},
    ParameterType{"vector2", "vector2", Values::kNumbers, 2},
    ParameterType{"point3", "point3", Values::kNumbers, 3},
    ParameterType{"point", "point3", Values::kNumbers, 3},
    ParameterType{"vector3", "vector3", Values::kNumbers, 3},
    ParameterType{"vector", "vector3", Values::kNumbers, 3},
    ParameterType{"normal", "normal", Values::kNumbers, 3},
    ParameterType{"normal3", "normal", Values::kNumbers, 3},
    ParameterType{"rgb", "rgb", Values::kNumbers, 3},
    // pbrt-v3's name, replaced by pbrt_v3.h.
    ParameterType{"color", "color", Values::kNumbers, 3},
    ParameterType{"blackbody", "blackbody", Values::kNumbers, 1},
    // The numbers of a spectrum are pairs of a wavelength and a value.
    ParameterType{"spectrum", "spectrum", Values::kSpectrum, 2},
    ParameterType{"bool", "bool", Values::kBools, 1},
    ParameterType{"string", "string", Values::kStrings, 1},
    ParameterType{"texture", "texture", Values::kStrings, 1},
};

}  // namespace

const ParameterType* find_parameter_type(std::string_view spelling) {
  const auto* const found =
      std::find_if(kParameterTypes.begin(), kParameterTypes.end(),
                   [&](const auto& type) { return spelling == type.spelling; });
  return found == kParameterTypes.end() ? nullptr : found;
}

std::string list_of_parameter_types() {
  std::string list;
  for (const ParameterType& type : kParameterTypes) {
    const std::string_view name = type.name;
    if (type.spelling != name || name == "color") continue;
    list += (list.empty() ? "" : ", ") + std::string(type.name);
  }
  return list;
}

}  // namespace nephroid
