// Texture classes by name; see texture_table.h.
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

constexpr FormatParameter kMapping[] = {
    {"string", "mapping", "uv", "", "uv, spherical, cylindrical or planar"},
    {"float", "uscale", "1", "", "of mapping uv"},
    {"float", "vscale", "1", "", "of mapping uv"},
    {"float", "udelta", "0", "", "of mappings uv and planar"},
    {"float", "vdelta", "0", "", "of mappings uv and planar"},
    {"vector3", "v1", "1 0 0", "", "of mapping planar"},
    {"vector3", "v2", "0 1 0", "", "of mapping planar"},
};
constexpr FormatParameter kNoise[] = {
    {"integer", "octaves", "8", "", "0 to 64"},
    {"float", "roughness", "0.5"},
};
constexpr FormatParameter kConstant[] = {{"values", "value", "1"}};
constexpr FormatParameter kScale[] = {
    {"values or texture", "tex", "1"},
    {"float or texture", "scale", "1"},
};
constexpr FormatParameter kMix[] = {
    {"values or texture", "tex1", "0"},
    {"values or texture", "tex2", "1"},
    {"float or texture", "amount", "0.5", "", "share of tex2"},
};
constexpr FormatParameter kDirectionMix[] = {
    {"values or texture", "tex1", "0", "", "where the surface faces the direction"},
    {"values or texture", "tex2", "1"},
    {"vector3", "dir", "0 1 0"},
};
constexpr FormatParameter kCheckerboard[] = {
    {"integer", "dimension", "2", "", "2 or 3; 3 has no mapping"},
    {"values or texture", "tex1", "1"},
    {"values or texture", "tex2", "0"},
};
constexpr FormatParameter kImageMap[] = {
    {"string", "filename", "none: an error", "", "EXR, PNG, JPEG, WebP, HDR, PFM, TGA, TIFF, BMP"},
    {"string", "filter", "bilinear", "",
     "point or bilinear; trilinear and ewa are bilinear on the finest level"},
    {"float", "maxanisotropy", "8", "", "of ewa", Support::kNotNeeded},
    {"string", "wrap", "repeat", "", "repeat, mirror, black, clamp or octahedralsphere"},
    {"float", "scale", "1"},
    {"bool", "invert", "false"},
    {"string", "encoding", "sRGB", "",
     "of PNG images: sRGB, linear or \"gamma X\"; with other images ignored with a warning"},
    {"bool", "forceencoding", "false", "",
     "\"encoding\" counts for all images that store integers; not in pbrt-v4"},
    {"bool", "vertexcolor", "false", "",
     "times the colours of the mesh's vertices, or their \"channel\"; not in pbrt-v4"},
};
constexpr FormatParameter kPlacement[] = {
    {"string", "uwrap", "wrap", "", "mode along u; not in pbrt-v4"},
    {"string", "vwrap", "wrap", "", "mode along v; not in pbrt-v4"},
    {"integer", "uvset", "0", "", "1: the second texture coordinates of the mesh; not in pbrt-v4"},
    {"float[6]", "uvtransform", "1 0 0 0 1 0", "",
     "two rows of a matrix for columns (u, v, 1), after the mapping; not in pbrt-v4"},
};
constexpr FormatParameter kChannel[] = {
    {"string", "channel", "none", "", "r, g, b or a, of float textures; not in pbrt-v4"},
    {"float", "cutoff", "none", "",
     "values below are 0, all others 1, of float textures; not in pbrt-v4"},
    {"rgb", "factor", "1 1 1", "", "of spectrum textures; not in pbrt-v4"},
};
constexpr FormatParameter kVertexColor[] = {{"float", "scale", "1", "", "of float textures"}};
constexpr FormatParameter kBilerp[] = {
    {"values", "v00", "0"}, {"values", "v10", "0"}, {"values", "v01", "1"}, {"values", "v11", "1"}};
constexpr FormatParameter kDots[] = {
    {"values or texture", "inside", "1", "", "between the dots, as in pbrt-v4"},
    {"values or texture", "outside", "0", "", "of the dots"},
};
constexpr FormatParameter kMarble[] = {
    {"float", "scale", "1"},
    {"float", "variation", "0.2"},
};
constexpr FormatParameter kPtex[] = {
    {"string", "filename"},
    {"string", "encoding", "gamma 2.2"},
    {"float", "scale", "1"},
};

/// A class with values of one kind only lacks one of the makers.
struct Row : FormatType {
  FloatTextureMaker make_float;
  SpectrumTextureMaker make_spectrum;
};
constexpr Row kTable[] = {
    {{"constant", {kConstant}}, make_float_constant, make_spectrum_constant},
    {{"scale", {kScale}}, make_float_scale, make_spectrum_scale},
    {{"mix", {kMix}}, make_float_mix, make_spectrum_mix},
    {{"directionmix", {kDirectionMix}}, make_float_directionmix, make_spectrum_directionmix},
    {{"checkerboard", {kCheckerboard, kMapping}},
     make_float_checkerboard,
     make_spectrum_checkerboard},
    {{"imagemap", {kImageMap, kPlacement, kChannel, kMapping}},
     make_float_imagemap,
     make_spectrum_imagemap},
    {{"vertexcolor", {kVertexColor, kChannel}, "\"vertexcolors\" of the mesh; not in pbrt-v4"},
     make_float_vertexcolor,
     make_spectrum_vertexcolor},
    {{"bilerp", {kBilerp, kMapping}}, make_float_bilerp, make_spectrum_bilerp},
    {{"dots", {kDots, kMapping}}, make_float_dots, make_spectrum_dots},
    {{"fbm", {kNoise}, "float only"}, make_float_fbm, nullptr},
    {{"wrinkled", {kNoise}, "float only"}, make_float_wrinkled, nullptr},
    {{"windy", {}, "float only"}, make_float_windy, nullptr},
    {{"marble", {kMarble, kNoise}, "spectrum only; a reflectance whatever it is used for"},
     nullptr,
     make_spectrum_marble},
    {{"ptex", {kPtex}, "there is no Ptex library among Debian's packages", Support::kRefused},
     nullptr,
     nullptr},
};

[[noreturn]] void wrong_values(const TextureDescription& description, const char* values) {
  throw SceneError(description.where, "texture class \"" + description.type + "\" has " + values +
                                          " values only, expected that type, or another class");
}

}  // namespace

std::vector<FormatType> texture_types() {
  return format_types(kTable);
}

const FormatType* find_texture_type(const std::string& name) {
  return find_row(kTable, name);
}

FloatTexturePtr make_float_texture(const TextureDescription& description, TextureScope& scope) {
  const Row& row = row_of(kTable, "texture class", description.type, description.where);
  if (!row.make_float) wrong_values(description, "spectrum");
  return row.make_float(description, scope);
}

SpectrumTexturePtr make_spectrum_texture(const TextureDescription& description, SpectrumKind kind,
                                         TextureScope& scope) {
  const Row& row = row_of(kTable, "texture class", description.type, description.where);
  if (!row.make_spectrum) wrong_values(description, "float");
  return row.make_spectrum(description, kind, scope);
}

}  // namespace nephroid
