// Texture classes by name, see texture_table.h.
#include "scene/texture/texture_table.h"

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
    {"imagemap", make_float_imagemap}, {"bilerp", make_float_bilerp},
    {"dots", make_float_dots},         {"directionmix", make_float_directionmix},
    {"fbm", make_float_fbm},           {"windy", make_float_windy},
    {"wrinkled", make_float_wrinkled},
};

constexpr Row<SpectrumTextureMaker> kSpectrumTextures[] = {
    {"constant", make_spectrum_constant}, {"scale", make_spectrum_scale},
    {"mix", make_spectrum_mix},           {"checkerboard", make_spectrum_checkerboard},
    {"imagemap", make_spectrum_imagemap}, {"bilerp", make_spectrum_bilerp},
    {"dots", make_spectrum_dots},         {"directionmix", make_spectrum_directionmix},
    {"marble", make_spectrum_marble},
};

template <class Maker, size_t N>
Maker find_maker(const Row<Maker> (&table)[N], const std::string& name) {
  for (const Row<Maker>& row : table)
    if (name == row.name) return row.make;
  return nullptr;
}

/// What is wrong with a class that is not in the table of its kind of values.
std::string complaint(const TextureDescription& description) {
  const std::string named = "texture class \"" + description.type + "\" ";
  if (description.type == "ptex")
    return named + "cannot be rendered: there is no Ptex library among Debian's packages";
  if (find_maker(kFloatTextures, description.type)) return named + "has float values only";
  if (find_maker(kSpectrumTextures, description.type)) return named + "has spectrum values only";
  return "unknown " + named.substr(0, named.size() - 1);
}

template <class Maker, size_t N>
Maker maker_of(const Row<Maker> (&table)[N], const TextureDescription& description) {
  if (const Maker maker = find_maker(table, description.type)) return maker;
  std::string names;
  for (const Row<Maker>& row : table)
    names += (names.empty() ? "\"" : ", \"") + std::string(row.name) + "\"";
  throw SceneError(description.where, complaint(description) + ", expected one of " + names);
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
