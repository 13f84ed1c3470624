// Mitsuba's textures as textures of pbrt-v4.
#pragma once

#include <string>
#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

enum class TextureUse {
  kColor,   ///< spectrum texture
  kNumber,  ///< float texture
};

/// The name of the texture, which is written at its first use.
std::string write_texture(ImportContext& context, const Object& object, TextureUse use);

/// A bitmap as the parameters of a material's normal map. Throws SceneError if the texture is
/// another one.
std::vector<Parameter> normal_map(ImportContext& context, const Object& object);

/// The image file of a bitmap, for lights. Throws SceneError if the texture is another one; warns
/// of its other properties.
std::string bitmap_file(ImportContext& context, const Object& object);

std::vector<Plugin> texture_plugins();

}  // namespace nephroid::mitsuba
