// The table of texture classes: the scene format's name and its makers. A new class is one file
// with its two makers and one row in texture_table.cpp. The makers must not know the library, only
// TextureScope.
#pragma once

#include <string>

#include "input/format_rows.h"
#include "scene/texture/image_file.h"
#include "scene/texture/texture.h"

namespace nephroid {

/// The parts of the scene that a maker can use: other textures, images, file locations.
class TextureScope {
 public:
  virtual ~TextureScope() = default;
  /// The parameter `name`, a number or a texture; by default the constant `fallback`.
  virtual FloatTexturePtr float_texture(const ParameterSet& parameters, const std::string& name,
                                        float fallback) = 0;
  /// The parameter `name`, a colour or a texture; by default the constant `fallback`.
  virtual SpectrumTexturePtr spectrum_texture(const ParameterSet& parameters,
                                              const std::string& name, SpectrumKind kind,
                                              float fallback) = 0;
  virtual ImageCache& images() = 0;
  virtual SceneFiles& files() = 0;
  virtual Diagnostics& diagnostics() = 0;
};

using FloatTextureMaker = FloatTexturePtr (*)(const TextureDescription&, TextureScope&);
using SpectrumTextureMaker = SpectrumTexturePtr (*)(const TextureDescription&, SpectrumKind,
                                                    TextureScope&);

/// All classes of the format, with their parameters.
std::vector<FormatType> texture_types();
/// The class with that name. Null if there is none.
const FormatType* find_texture_type(const std::string& name);

/// Makes a texture of the description's class. Throws SceneError at the directive if the class does
/// not exist or is not supported yet.
FloatTexturePtr make_float_texture(const TextureDescription& description, TextureScope& scope);
SpectrumTexturePtr make_spectrum_texture(const TextureDescription& description, SpectrumKind kind,
                                         TextureScope& scope);

// The makers, one pair per file.
FloatTexturePtr make_float_constant(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_constant(const TextureDescription&, SpectrumKind, TextureScope&);
FloatTexturePtr make_float_scale(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_scale(const TextureDescription&, SpectrumKind, TextureScope&);
FloatTexturePtr make_float_mix(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_mix(const TextureDescription&, SpectrumKind, TextureScope&);
FloatTexturePtr make_float_checkerboard(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_checkerboard(const TextureDescription&, SpectrumKind,
                                              TextureScope&);
FloatTexturePtr make_float_imagemap(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_imagemap(const TextureDescription&, SpectrumKind, TextureScope&);
FloatTexturePtr make_float_vertexcolor(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_vertexcolor(const TextureDescription&, SpectrumKind,
                                             TextureScope&);
FloatTexturePtr make_float_bilerp(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_bilerp(const TextureDescription&, SpectrumKind, TextureScope&);
FloatTexturePtr make_float_directionmix(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_directionmix(const TextureDescription&, SpectrumKind,
                                              TextureScope&);
FloatTexturePtr make_float_dots(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_dots(const TextureDescription&, SpectrumKind, TextureScope&);
FloatTexturePtr make_float_fbm(const TextureDescription&, TextureScope&);
FloatTexturePtr make_float_windy(const TextureDescription&, TextureScope&);
FloatTexturePtr make_float_wrinkled(const TextureDescription&, TextureScope&);
SpectrumTexturePtr make_spectrum_marble(const TextureDescription&, SpectrumKind, TextureScope&);

}  // namespace nephroid
