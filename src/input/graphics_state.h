// The graphics state that AttributeBegin saves: current transform, material, media, area light and
// default parameters. It must not know the syntax.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/scene_description.h"

namespace nephroid {

/// The targets of the directive Attribute "target", which sets default parameters.
enum class AttributeTarget { kShape, kLight, kMaterial, kMedium, kTexture };
inline constexpr std::array<std::string_view, 5> kAttributeTargets = {"shape", "light", "material",
                                                                      "medium", "texture"};

struct GraphicsState {
  TransformDescription ctm;
  bool start_active = true, end_active = true;  ///< keyframes that transform directives change
  /// Direction in camera space that the last LookAt calls up, if no Transform came after it.
  std::optional<Vec3d> up_in_camera;
  bool reverse_orientation = false;
  std::string color_space = "srgb";
  MaterialReference material;  ///< neither index nor name: the default material
  std::optional<DirectiveDescription> area_light;
  std::string inside_medium, outside_medium;
  std::array<std::vector<Parameter>, kAttributeTargets.size()> defaults;  ///< [AttributeTarget]
};

}  // namespace nephroid
