// What the attribute directives of a pbrt-v4 scene have set so far and AttributeBegin saves: the
// current transform, material, media, area light and default parameters.
// Used by the scene builder only. Knows nothing of syntax.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// What a directive Attribute "target" gives default parameters to.
enum class AttributeTarget { kShape, kLight, kMaterial, kMedium, kTexture };
inline constexpr std::array<std::string_view, 5> kAttributeTargets = {"shape", "light", "material",
                                                                      "medium", "texture"};

struct GraphicsState {
  TransformDescription ctm;
  bool start_active = true, end_active = true;  ///< which keyframes the transform directives change
  bool reverse_orientation = false;
  std::string color_space = "srgb";
  MaterialReference material;  ///< neither index nor name: the default material
  std::optional<DirectiveDescription> area_light;
  std::string inside_medium, outside_medium;
  std::array<std::vector<Parameter>, kAttributeTargets.size()> defaults;  ///< by AttributeTarget
};

}  // namespace nephroid
