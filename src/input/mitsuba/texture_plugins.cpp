// In meshes v is turned over (see mesh_shapes.h): pbrt-v4 has v = 0 at the lower edge of an image,
// Mitsuba at the upper one.
#include "input/mitsuba/texture_plugins.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "input/file_bytes.h"
#include "input/mitsuba/color_value.h"
#include "input/mitsuba/parameter_values.h"

namespace nephroid::mitsuba {
namespace {

/// s = scale * u + offset, in Mitsuba's uv.
struct UvMap {
  double u_scale = 1, v_scale = 1, u_offset = 0, v_offset = 0;
};

UvMap read_uv_map(PluginProperties& p) {
  UvMap map;
  if (p.text("coordinates", "uv") != "uv")
    warn_approximated(p, "coordinates other than uv are not supported, uv are used");
  if (p.has("to_uv")) {
    const Mat44d m = p.transform("to_uv").start;
    if (std::abs(m[0][1]) + std::abs(m[1][0]) > 1e-6)
      warn_approximated(p, "the rotation in \"to_uv\" is ignored");
    return {m[0][0], m[1][1], m[3][0], m[3][1]};
  }
  const double scale = p.number("uvscale", 1);
  map.u_scale = p.number("uscale", scale);
  map.v_scale = p.number("vscale", scale);
  map.u_offset = p.number("uoffset", 0);
  map.v_offset = p.number("voffset", 0);
  return map;
}

bool stores_floats(const std::string& file) {
  return has_suffix(file, ".exr") || has_suffix(file, ".hdr") || has_suffix(file, ".pfm") ||
         has_suffix(file, ".rgbe");
}

void add_encoding(PluginProperties& p, ParameterSet& set, const std::string& file, TextureUse use) {
  const double gamma = p.number("gamma", use == TextureUse::kHeight ? 1 : 0);
  const bool raw = p.boolean("raw", false);
  if (stores_floats(file)) return;
  if (raw || gamma == 1)
    add_text(set, "encoding", "linear");
  else if (gamma > 0)
    add_text(set, "encoding", fmt::format("gamma {}", gamma));
}

void add_wrap(PluginProperties& p, ParameterSet& set) {
  const std::string both = p.text("wrap_mode", "repeat");
  const std::string u = p.text("wrap_mode_u", both), v = p.text("wrap_mode_v", both);
  if (u != v) warn_approximated(p, "wrap modes differ in u and v, that of u is used");
  if (u == "clamp" || u == "repeat") {
    add_text(set, "wrap", u);
  } else if (u == "zero") {
    add_text(set, "wrap", "black");
  } else if (u == "mirror" || u == "one") {
    warn_approximated(p, "wrap mode \"" + u + "\" is rendered as repeat");
    add_text(set, "wrap", "repeat");
  } else {
    throw SceneError(p.where(), "wrap mode \"" + u +
                                    "\" is unknown, expected repeat, clamp, "
                                    "mirror, zero or one");
  }
}

void write_bitmap(PluginProperties& p, TextureDescription& t, TextureUse use) {
  t.type = "imagemap";
  const std::string file = p.file();
  add_text(t.parameters, "filename", file);
  add_encoding(p, t.parameters, file, use);
  add_wrap(p, t.parameters);
  const std::string filter = p.text("filter_type", "bilinear");
  add_text(t.parameters, "filter", filter == "nearest" ? "point" : "bilinear");
  if (!p.text("channel", "").empty())
    warn_approximated(p, "\"channel\" is ignored, all channels count");
  const UvMap map = read_uv_map(p);
  add_float(t.parameters, "uscale", map.u_scale);
  add_float(t.parameters, "vscale", map.v_scale);
  add_float(t.parameters, "udelta", map.u_offset);
  add_float(t.parameters, "vdelta", 1 - map.v_scale - map.v_offset);
}

void add_values(PluginProperties& p, ParameterSet& set, const std::string& source,
                const std::string& target, TextureUse use, double fallback) {
  if (use == TextureUse::kColor) {
    add_color(set, target, read_color(p, source, ColorUse::kUnbounded), fallback);
  } else if (const auto value = read_float(p, source)) {
    add_as(set, target, *value);
  } else {
    add_float(set, target, fallback);
  }
}

/// Mitsuba's checks are half a unit wide.
void write_checkerboard(PluginProperties& p, TextureDescription& t, TextureUse use) {
  t.type = "checkerboard";
  add_values(p, t.parameters, "color0", "tex1", use, 0.4);
  add_values(p, t.parameters, "color1", "tex2", use, 0.2);
  const UvMap map = read_uv_map(p);
  add_float(t.parameters, "uscale", 2 * map.u_scale);
  add_float(t.parameters, "vscale", -2 * map.v_scale);
  add_float(t.parameters, "udelta", 2 * map.u_offset);
  add_float(t.parameters, "vdelta", 2 * (map.v_scale + map.v_offset));
}

void write_scale(PluginProperties& p, TextureDescription& t, TextureUse use) {
  t.type = "scale";
  const Object* nested = p.first_child("texture");
  if (nested) {
    add_as(
        t.parameters, "tex",
        text_parameter("texture", "", {write_texture(p.context(), *nested, use)}, nested->where));
  } else {
    add_values(p, t.parameters, "value", "tex", use, 1);
  }
  const Vec3d scale = read_rgb(p, "scale").value_or(Vec3d(1.0));
  if (scale.x != scale.y || scale.y != scale.z)
    warn_approximated(p, "a coloured \"scale\" is replaced by its mean");
  add_float(t.parameters, "scale", mean(scale));
}

/// Colours of .serialized meshes; surfaces without are white.
void write_vertex_colors(PluginProperties& p, TextureDescription& t, TextureUse use) {
  t.type = "vertexcolor";
  if (p.text("name", "vertex_color") != "vertex_color")
    warn_approximated(p, "vertices have no attribute but \"vertex_color\", which is used");
  const double scale = p.number("scale", 1);
  if (use == TextureUse::kColor)
    add_rgb(t.parameters, "factor", Vec3d(scale));
  else
    add_float(t.parameters, "scale", scale);
}

struct TextureRow : Plugin {
  void (*write)(PluginProperties& properties, TextureDescription& texture,
                TextureUse use) = nullptr;
};
constexpr PluginSupport kLoaded = PluginSupport::kLoaded, kRefused = PluginSupport::kRefused,
                        kApproximated = PluginSupport::kApproximated;
constexpr const char* kOfSerialized = "those of .serialized meshes; others are white";
constexpr const char* kNoSuchTexture = "this renderer has no such texture";
constexpr TextureRow kTextures[] = {
    {{"texture", "bitmap", kLoaded, "bilinear; rotations of uv are ignored with a warning"},
     write_bitmap},
    {{"texture", "checkerboard"}, write_checkerboard},
    {{"texture", "scale", kLoaded, "a coloured scale is replaced by its mean, with a warning"},
     write_scale},
    {{"texture", "vertexcolors", kLoaded, kOfSerialized}, write_vertex_colors},
    {{"texture", "mesh_attribute", kApproximated, kOfSerialized}, write_vertex_colors},
    {{"texture", "gridtexture", kRefused, kNoSuchTexture}},
    {{"texture", "wireframe", kRefused, kNoSuchTexture}},
    {{"texture", "curvature", kRefused, kNoSuchTexture}},
    {{"texture", "volume", kRefused, kNoSuchTexture}},
};

const char* suffix_of(TextureUse use) {
  if (use == TextureUse::kColor) return "";
  return use == TextureUse::kNumber ? "-number" : "-height";
}

}  // namespace

std::string write_texture(ImportContext& context, const Object& object, TextureUse use) {
  const auto known = context.textures.find({&object, suffix_of(use)});
  if (known != context.textures.end()) return known->second;
  PluginProperties properties(object, context);
  TextureDescription texture = directive<TextureDescription>("", object.where);
  plugin_row(kTextures, object, context.diagnostics).write(properties, texture, use);
  properties.report_unused();
  texture.name = context.unique_name(object) + suffix_of(use);
  context.names.insert(texture.name);
  texture.value_type = use == TextureUse::kColor ? "spectrum" : "float";
  context.scene.textures.push_back(texture);
  return context.textures[{&object, suffix_of(use)}] = texture.name;
}

std::string bitmap_file(ImportContext& context, const Object& object) {
  if (object.type != "bitmap")
    throw SceneError(object.where,
                     "texture \"" + object.type + "\" has no image file, expected a bitmap");
  PluginProperties properties(object, context);
  std::string file = properties.file();
  properties.number("gamma", 0);
  properties.boolean("raw", false);
  properties.text("filter_type", "");
  properties.text("wrap_mode", "");
  properties.report_unused();
  return file;
}

std::vector<Plugin> texture_plugins() {
  return std::vector<Plugin>(std::begin(kTextures), std::end(kTextures));
}

}  // namespace nephroid::mitsuba
