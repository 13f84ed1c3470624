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

/// Two rows of a matrix for columns (u, v, 1), in Mitsuba's uv.
struct UvMap {
  double u[3] = {1, 0, 0}, v[3] = {0, 1, 0};

  bool turns() const { return std::abs(u[1]) + std::abs(v[0]) > 1e-6; }
  bool is_identity() const { return !turns() && u[0] == 1 && u[2] == 0 && v[1] == 1 && v[2] == 0; }
};

UvMap read_uv_map(PluginProperties& p) {
  if (p.text("coordinates", "uv") != "uv")
    warn_approximated(p, "coordinates other than uv are not supported, uv are used");
  if (p.has("to_uv")) {
    const Mat44d m = p.transform("to_uv").start;
    return {{m[0][0], m[1][0], m[3][0]}, {m[0][1], m[1][1], m[3][1]}};
  }
  const double scale = p.number("uvscale", 1);
  return {{p.number("uscale", scale), 0, p.number("uoffset", 0)},
          {0, p.number("vscale", scale), p.number("voffset", 0)}};
}

/// The same map where v is turned over before and after it.
void add_uv_transform(ParameterSet& set, const std::string& name, const UvMap& map) {
  add_numbers(
      set, "float", name,
      {map.u[0], -map.u[1], map.u[2] + map.u[1], -map.v[0], map.v[1], 1 - map.v[1] - map.v[2]});
}

bool stores_floats(const std::string& file) {
  return has_suffix(file, ".exr") || has_suffix(file, ".hdr") || has_suffix(file, ".pfm") ||
         has_suffix(file, ".rgbe");
}

void add_encoding(PluginProperties& p, ParameterSet& set, const std::string& file) {
  const double gamma = p.number("gamma", 0);
  const bool raw = p.boolean("raw", false);
  if (stores_floats(file) || !(raw || gamma > 0)) return;
  add_text(set, "encoding", raw || gamma == 1 ? "linear" : fmt::format("gamma {}", gamma));
  // pbrt-v4 has encodings of PNG files only.
  if (!has_suffix(file, ".png")) add_bool(set, "forceencoding", true);
}

/// pbrt-v4's name of a wrap mode.
std::string wrap_mode(PluginProperties& p, const std::string& mode) {
  if (mode == "clamp" || mode == "repeat" || mode == "mirror") return mode;
  if (mode == "zero") return "black";
  if (mode != "one")
    throw SceneError(p.where(), "wrap mode \"" + mode +
                                    "\" is unknown, expected repeat, clamp, mirror, zero or one");
  warn_approximated(p, "wrap mode \"one\" is rendered as repeat");
  return "repeat";
}

struct Wrap {
  std::string u, v;
};

Wrap read_wrap(PluginProperties& p) {
  const std::string both = p.text("wrap_mode", "repeat");
  return {wrap_mode(p, p.text("wrap_mode_u", both)), wrap_mode(p, p.text("wrap_mode_v", both))};
}

void add_channel(PluginProperties& p, ParameterSet& set, TextureUse use) {
  const std::string channel = p.text("channel", "");
  if (channel.empty()) return;
  const bool is_color = channel == "r" || channel == "g" || channel == "b" || channel == "a";
  if (use == TextureUse::kNumber && is_color)
    add_text(set, "channel", channel);
  else
    warn_approximated(p, "\"channel\" is ignored, all channels count");
}

void write_bitmap(PluginProperties& p, TextureDescription& t, TextureUse use) {
  t.type = "imagemap";
  const std::string file = p.file();
  add_text(t.parameters, "filename", file);
  add_encoding(p, t.parameters, file);
  const Wrap wrap = read_wrap(p);
  add_text(t.parameters, "wrap", wrap.u);
  if (wrap.v != wrap.u) add_text(t.parameters, "vwrap", wrap.v);
  const std::string filter = p.text("filter_type", "bilinear");
  add_text(t.parameters, "filter", filter == "nearest" ? "point" : "bilinear");
  add_channel(p, t.parameters, use);
  const UvMap map = read_uv_map(p);
  if (map.turns()) {
    add_uv_transform(t.parameters, "uvtransform", map);
    return;
  }
  add_float(t.parameters, "uscale", map.u[0]);
  add_float(t.parameters, "vscale", map.v[1]);
  add_float(t.parameters, "udelta", map.u[2]);
  add_float(t.parameters, "vdelta", 1 - map.v[1] - map.v[2]);
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
  if (map.turns()) warn_approximated(p, "the rotation in \"to_uv\" is ignored");
  add_float(t.parameters, "uscale", 2 * map.u[0]);
  add_float(t.parameters, "vscale", -2 * map.v[1]);
  add_float(t.parameters, "udelta", 2 * map.u[2]);
  add_float(t.parameters, "vdelta", 2 * (map.v[1] + map.v[2]));
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

/// Surfaces without colours are white.
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
using enum PluginSupport;
constexpr const char* kOfMeshes = "those of .serialized and PLY meshes; others are white";
constexpr const char* kNoSuchTexture = "this renderer has no such texture";
constexpr TextureRow kTextures[] = {
    {{"texture", "bitmap", kLoaded, "bilinear"}, write_bitmap},
    {{"texture", "checkerboard", kLoaded, "rotations of uv are ignored with a warning"},
     write_checkerboard},
    {{"texture", "scale", kLoaded, "a coloured scale is replaced by its mean, with a warning"},
     write_scale},
    {{"texture", "vertexcolors", kLoaded, kOfMeshes}, write_vertex_colors},
    {{"texture", "mesh_attribute", kLoaded, "vertex_color of .serialized and PLY meshes"},
     write_vertex_colors},
    {{"texture", "gridtexture", kRefused, kNoSuchTexture}},
    {{"texture", "wireframe", kRefused, kNoSuchTexture}},
    {{"texture", "curvature", kRefused, kNoSuchTexture}},
    {{"texture", "volume", kRefused, kNoSuchTexture}},
};

const char* suffix_of(TextureUse use) {
  return use == TextureUse::kColor ? "" : "-number";
}

void expect_bitmap(const Object& object) {
  if (object.type != "bitmap")
    throw SceneError(object.where,
                     "texture \"" + object.type + "\" has no image file, expected a bitmap");
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

std::vector<Parameter> normal_map(ImportContext& context, const Object& object) {
  expect_bitmap(object);
  PluginProperties p(object, context);
  ParameterSet set;
  set.where = object.where;
  add_text(set, "normalmap", p.file());
  // The numbers of normals are never decoded.
  p.number("gamma", 1);
  p.boolean("raw", true);
  p.text("filter_type", "");
  const Wrap wrap = read_wrap(p);
  if (wrap.u != "repeat") add_text(set, "normalmap.uwrap", wrap.u);
  if (wrap.v != "repeat") add_text(set, "normalmap.vwrap", wrap.v);
  const UvMap map = read_uv_map(p);
  if (!map.is_identity()) add_uv_transform(set, "normalmap.uvtransform", map);
  p.report_unused();
  return set.list;
}

std::string bitmap_file(ImportContext& context, const Object& object) {
  expect_bitmap(object);
  PluginProperties p(object, context);
  std::string file = p.file();
  p.text("filter_type", "");
  const bool is_encoded = p.boolean("raw", false) || p.number("gamma", 0) > 0;
  if (is_encoded && !stores_floats(file))
    warn_approximated(p, "\"raw\" and \"gamma\" of a light's image are ignored");
  if (!read_uv_map(p).is_identity())
    warn_approximated(p, "the map of uv of a light's image is ignored");
  if (read_wrap(p).u != "repeat")
    warn_approximated(p, "the wrap mode of a light's image is ignored");
  p.report_unused();
  return file;
}

std::vector<Plugin> texture_plugins() {
  return std::vector<Plugin>(std::begin(kTextures), std::end(kTextures));
}

}  // namespace nephroid::mitsuba
