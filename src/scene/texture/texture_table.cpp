// Texture classes by name, see texture_table.h.
#include "scene/texture/texture_table.h"

#include <algorithm>
#include <iterator>

namespace nephroid {

namespace {

template <class Maker>
struct Row {
  const char* name;
  Maker make;
};

constexpr Row<FloatTextureMaker> kFloatTextures[] = {
    {"constant", make_float_constant}, {"scale", make_float_scale},
    {"mix", make_float_mix},           {"checkerboard", make_float_checkerboard},
    {"imagemap", make_float_imagemap},
};

constexpr Row<SpectrumTextureMaker> kSpectrumTextures[] = {
    {"constant", make_spectrum_constant}, {"scale", make_spectrum_scale},
    {"mix", make_spectrum_mix},           {"checkerboard", make_spectrum_checkerboard},
    {"imagemap", make_spectrum_imagemap},
};

/// Classes of pbrt-v4 that this renderer knows by name only.
constexpr const char* kNotRenderedYet[] = {"bilerp", "directionmix", "dots",  "fbm",
                                           "marble", "ptex",         "windy", "wrinkled"};

template <class Maker, size_t N>
Maker maker_of(const Row<Maker> (&table)[N], const TextureDescription& description) {
  for (const Row<Maker>& row : table)
    if (description.type == row.name) return row.make;
  const bool known = std::any_of(std::begin(kNotRenderedYet), std::end(kNotRenderedYet),
                                 [&](const char* n) { return description.type == n; });
  std::string names;
  for (const Row<Maker>& row : table)
    names += (names.empty() ? "\"" : ", \"") + std::string(row.name) + "\"";
  throw SceneError(
      description.where,
      (known ? "texture class \"" + description.type + "\" is not rendered yet, expected one of "
             : "unknown texture class \"" + description.type + "\", expected one of ") +
          names);
}

}  // namespace

FloatTexturePtr make_float_texture(const TextureDescription& description, TextureScope& scope) {
  return maker_of(kFloatTextures, description)(description, scope);
}

SpectrumTexturePtr make_spectrum_texture(const TextureDescription& description, SpectrumKind kind,
                                         TextureScope& scope) {
  return maker_of(kSpectrumTextures, description)(description, kind, scope);
}

}  // namespace nephroid
