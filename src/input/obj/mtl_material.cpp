#include "input/obj/mtl_material.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "input/parameter_list.h"

namespace nephroid {
namespace {

using Color = MtlMaterial::Color;

constexpr double kSharpExponent = 200;  ///< Ns from which traced reflections are sharp

double largest(const Color& c) {
  return *std::max_element(c.begin(), c.end());
}
Color divided(const Color& c, double by) {
  return by > 0 ? Color{c[0] / by, c[1] / by, c[2] / by} : Color{1, 1, 1};
}
bool is_grey(const Color& c) {
  return c[0] == c[1] && c[1] == c[2];
}
double unit(double value) {
  return std::clamp(value, 0.0, 1.0);
}
Color unit(const Color& c) {
  return {unit(c[0]), unit(c[1]), unit(c[2])};
}

class Converter {
 public:
  Converter(const MtlMaterial& mtl, bool solid_glass, std::vector<TextureDescription>* textures,
            Diagnostics& diagnostics)
      : mtl_(mtl),
        textures_(textures),
        diagnostics_(diagnostics),
        list_(mtl.where),
        illum_(static_cast<int>(std::clamp(number("illum", 2), -1e6, 1e6))),
        opacity_(unit(number("d", 1))),
        is_glass_(glass(solid_glass)) {}

  ConvertedMaterial convert() {
    add_base();
    add_specular();
    if (is_glass_) add_transmission();
    add_layers();
    add_relief();
    ConvertedMaterial result;
    result.area_light = area_light();
    result.alpha = alpha();
    static_cast<DirectiveDescription&>(result.material) = std::move(list_).directive("principled");
    result.material.name = mtl_.name;
    return result;
  }

 private:
  double number(const char* keyword, double fallback) const {
    return mtl_.number(keyword).value_or(fallback);
  }
  bool traces_reflections() const { return illum_ >= 3 && illum_ <= 9; }
  bool glass(bool solid_glass) const {
    if (number("Ni", 1.5) == 1) return false;
    if (illum_ == 6 || illum_ == 7) return true;
    return opacity_ < 1 && (illum_ == 4 || illum_ == 9 || solid_glass);
  }
  bool is_mirror() const {
    return (illum_ == 3 || illum_ == 5) && !mtl_.number("Pm") && !mtl_.map("map_Kd") &&
           largest(mtl_.color("Kd").value_or(Color{0, 0, 0})) == 0 &&
           largest(mtl_.color("Ks").value_or(Color{0, 0, 0})) > 0;
  }

  /// Adds the image as a texture and returns its name.
  std::string texture(const char* keyword, const MtlMap& map, const char* value_type, double scale);
  /// Adds `parameter` as the image of `keyword`, if there is one.
  bool add_map(const char* parameter, const char* keyword, const char* value_type,
               double scale = 1);
  void add_base();
  void add_specular();
  void add_roughness();
  void add_transmission();
  void add_layers();
  void add_relief();
  std::optional<DirectiveDescription> area_light() const;
  std::optional<Parameter> alpha();

  const MtlMaterial& mtl_;
  std::vector<TextureDescription>* textures_;
  Diagnostics& diagnostics_;
  ParameterList list_;
  int illum_;
  double opacity_;
  bool is_glass_;
};

/// Adds scale, offset and wrapping of an image under the names of normal maps and lights, whose
/// wrapping is `usual` if none is given.
void add_placement(const MtlMap& map, const std::string& prefix, const char* usual,
                   ParameterList* list) {
  if (map.u_scale != 1 || map.v_scale != 1 || map.u_offset != 0 || map.v_offset != 0)
    list->add_numbers("float", prefix + "uvtransform",
                      {map.u_scale, 0, map.u_offset, 0, map.v_scale, map.v_offset});
  const char* const wrap = map.clamps ? "clamp" : "repeat";
  if (wrap == std::string_view(usual)) return;
  list->add_string(prefix + "uwrap", wrap);
  list->add_string(prefix + "vwrap", wrap);
}

std::string Converter::texture(const char* keyword, const MtlMap& map, const char* value_type,
                               double scale) {
  ParameterList list(map.where);
  list.add_string("filename", map.file);
  if (map.u_scale != 1) list.add_float("uscale", map.u_scale);
  if (map.v_scale != 1) list.add_float("vscale", map.v_scale);
  if (map.u_offset != 0) list.add_float("udelta", map.u_offset);
  if (map.v_offset != 0) list.add_float("vdelta", map.v_offset);
  if (map.clamps) list.add_string("wrap", "clamp");
  if (scale != 1) list.add_float("scale", scale);
  // Numbers are stored as they are; colours are sRGB, which is the default.
  if (value_type == std::string_view("float")) {
    list.add_string("encoding", "linear");
    list.add_bool("forceencoding", true);
  }
  TextureDescription& texture = textures_->emplace_back();
  static_cast<DirectiveDescription&>(texture) = std::move(list).directive("imagemap");
  texture.name = mtl_.name + " " + keyword;
  texture.value_type = value_type;
  return texture.name;
}

bool Converter::add_map(const char* parameter, const char* keyword, const char* value_type,
                        double scale) {
  const MtlMap* map = mtl_.map(keyword);
  if (map) list_.add_texture(parameter, texture(keyword, *map, value_type, scale));
  return map != nullptr;
}

void Converter::add_base() {
  const Color kd =
      unit(mtl_.color("Kd").value_or(mtl_.map("map_Kd") ? Color{1, 1, 1} : Color{0.8, 0.8, 0.8}));
  if (is_mirror()) {
    list_.add_color("base_color", unit(*mtl_.color("Ks")));
    list_.add_float("base_metalness", 1);
    return;
  }
  if (mtl_.map("map_Kd") && !is_grey(kd))
    diagnostics_.warn(mtl_.where,
                      "Kd is a colour and map_Kd an image: the image is multiplied by "
                      "the largest component of Kd only");
  if (!add_map("base_color", "map_Kd", "spectrum", largest(kd))) list_.add_color("base_color", kd);
  if (!add_map("base_metalness", "map_Pm", "float"))
    list_.add_float("base_metalness", unit(number("Pm", 0)));
}

/// The exponent of Blinn's highlight as alpha = roughness^2 (Walter et al. 2007, equation 30).
void Converter::add_roughness() {
  const bool is_sharp = traces_reflections() && number("Ns", kSharpExponent) >= kSharpExponent;
  const double alpha = std::sqrt(2 / (std::max(0.0, number("Ns", 0)) + 2));
  const double roughness = is_sharp ? 0 : std::sqrt(alpha);
  if (!add_map("specular_roughness", "map_Pr", "float"))
    list_.add_float("specular_roughness", unit(number("Pr", roughness)));
}

void Converter::add_specular() {
  const bool is_physical = mtl_.number("Pr") || mtl_.number("Pm") || mtl_.map("map_Pr") ||
                           mtl_.map("map_Pm") || is_glass_ || is_mirror();
  const Color ks = unit(mtl_.color("Ks").value_or(Color{0, 0, 0}));
  const bool has_highlight = illum_ >= 2 && (largest(ks) > 0 || mtl_.map("map_Ks"));
  // Ni is for refraction. Files with highlights and no glass often have a Ni of 1, of which nothing
  // is reflected.
  const double ior = number("Ni", 1.5);
  const bool is_for_highlight = has_highlight && !is_physical && ior <= 1;
  list_.add_float("specular_ior", is_for_highlight ? 1.5 : std::clamp(ior, 1.0, 10.0));
  add_roughness();
  if (is_physical) return;
  list_.add_float("specular_weight", has_highlight ? (largest(ks) > 0 ? largest(ks) : 1) : 0);
  if (!has_highlight) return;
  if (mtl_.map("map_Ks") && !is_grey(ks))
    diagnostics_.warn(mtl_.where,
                      "Ks is a colour and map_Ks an image: the image is multiplied by "
                      "the largest component of Ks only");
  if (!add_map("specular_color", "map_Ks", "spectrum"))
    list_.add_color("specular_color", divided(ks, largest(ks)));
}

void Converter::add_transmission() {
  const Color tf = unit(mtl_.color("Tf").value_or(Color{1, 1, 1}));
  list_.add_float("transmission_weight", opacity_ < 1 ? 1 - opacity_ : 1);
  list_.add_color("transmission_color", largest(tf) > 0 ? tf : Color{1, 1, 1});
  if (largest(tf) == 0)
    diagnostics_.warn(mtl_.where,
                      "Tf of a glass is black, expected the colour of the light that passes; the "
                      "glass is rendered clear");
}

void Converter::add_layers() {
  const auto add_unit = [&](const char* keyword, const char* parameter) {
    if (const double value = unit(number(keyword, 0)); value > 0) list_.add_float(parameter, value);
  };
  add_unit("Ps", "fuzz_weight");
  add_unit("Pc", "coat_weight");
  add_unit("Pcr", "coat_roughness");
  add_unit("aniso", "specular_roughness_anisotropy");
}

void Converter::add_relief() {
  if (const MtlMap* normals = mtl_.map("norm")) {
    list_.add_string("normalmap", normals->file);
    add_placement(*normals, "normalmap.", "repeat", &list_);
    if (mtl_.map("bump"))
      diagnostics_.warn(mtl_.where, "bump is ignored, since the material has a norm, too");
    return;
  }
  if (const MtlMap* bump = mtl_.map("bump")) add_map("displacement", "bump", "float", bump->bump);
}

std::optional<DirectiveDescription> Converter::area_light() const {
  const Color ke = mtl_.color("Ke").value_or(mtl_.map("map_Ke") ? Color{1, 1, 1} : Color{});
  if (largest(ke) == 0) return std::nullopt;
  ParameterList list(mtl_.where);
  if (const MtlMap* map = mtl_.map("map_Ke")) {
    list.add_string("filename", map->file);
    add_placement(*map, "", "clamp", &list);
    if (!is_grey(ke)) list.add_color("factor", divided(ke, largest(ke)));
    list.add_float("scale", largest(ke));
  } else {
    list.add_color("L", ke);
  }
  list.add_bool("twosided", true);
  if (!mtl_.name.empty()) list.add_string("name", mtl_.name);
  return std::move(list).directive("diffuse");
}

std::optional<Parameter> Converter::alpha() {
  if (is_glass_) return std::nullopt;
  ParameterList list(mtl_.where);
  if (const MtlMap* map = mtl_.map("map_d"))
    list.add_texture("alpha", texture("map_d", *map, "float", opacity_));
  else if (opacity_ < 1)
    list.add_float("alpha", opacity_);
  else
    return std::nullopt;
  return list.take().list.front();
}

}  // namespace

ConvertedMaterial convert_mtl(const MtlMaterial& mtl, bool solid_glass,
                              std::vector<TextureDescription>* textures, Diagnostics& diagnostics) {
  return Converter(mtl, solid_glass, textures, diagnostics).convert();
}

}  // namespace nephroid
