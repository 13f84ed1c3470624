// Mitsuba 3's principled BSDFs (Burley 2012, 2015) as "principled" in the terms of OpenPBR.
#include <algorithm>
#include <cmath>
#include <utility>

#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/refraction_index.h"

namespace nephroid::mitsuba {
namespace {

/// Copies a number or texture times a factor; nothing is written if it is absent.
void copy_float(PluginProperties& p, const char* from, ParameterSet& set, const char* to,
                double factor = 1) {
  if (auto value = read_float(p, from)) add_as(set, to, scaled(p, std::move(*value), factor));
}

/// A constant of the model; a texture is replaced by `fallback` with a warning.
double constant(PluginProperties& p, const char* name, double fallback) {
  const auto value = read_float(p, name);
  if (!value) return fallback;
  if (value->type == "float") return value->numbers[0];
  warn_approximated(p, std::string("a texture of \"") + name + "\" is ignored");
  return fallback;
}

/// The index that "specular" stands for (Burley 2015): F0 = 0.08 specular.
double index_of_specular(double specular) {
  return 2 / (1 - std::sqrt(0.08 * std::clamp(specular, 0.0, 1.0))) - 1;
}

/// Burley's alphas are roughness^2 / a and roughness^2 a with a^2 = 1 - 0.9 anisotropic. OpenPBR's
/// have the ratio 1 - anisotropy and the mean square roughness^4.
void add_facets(PluginProperties& p, ParameterSet& set) {
  Parameter roughness =
      read_float(p, "roughness").value_or(numbers_parameter("float", "", {0.5}, p.where()));
  const auto anisotropic = read_float(p, "anisotropic");
  double factor = 1;
  if (anisotropic && anisotropic->type == "float") {
    const double across = 1 - 0.9 * std::clamp(anisotropic->numbers[0], 0.0, 1.0);
    factor = std::pow(0.5 * (1 / across + across), 0.25);
  }
  add_as(set, "specular_roughness", scaled(p, std::move(roughness), factor));
  if (anisotropic) add_as(set, "specular_roughness_anisotropy", scaled(p, *anisotropic, 0.9));
}

/// White mixed with the base colour, which is given luminance 1 (Burley 2012); white without tint.
Vec3d tint(PluginProperties& p, const char* name) {
  const double share = std::clamp(constant(p, name, 0), 0.0, 1.0);
  const auto base = read_color(p, "base_color", ColorUse::kReflectance);
  if (share == 0 || !base) return Vec3d(1.0);
  if (!base->rgb) {
    warn_approximated(p, std::string("\"") + name + "\" of a textured base colour is ignored");
    return Vec3d(1.0);
  }
  const Vec3d& c = *base->rgb;
  const double luminance = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
  if (!(luminance > 0)) return Vec3d(1.0);
  return Vec3d(1.0) + (c / luminance - Vec3d(1.0)) * share;
}

/// Its components may be above 1: the largest one goes to the weight.
double largest(const Vec3d& color) {
  return std::max({color.x, color.y, color.z});
}

void add_sheen(PluginProperties& p, ParameterSet& set) {
  const auto sheen = read_float(p, "sheen");
  const bool has_sheen = sheen && (sheen->type == "texture" || sheen->numbers[0] > 0);
  if (!has_sheen) {
    // Exporters write a tint in any case.
    p.find("sheen_tint");
    p.child("texture", "sheen_tint");
    return;
  }
  const Vec3d color = tint(p, "sheen_tint");
  add_as(set, "fuzz_weight", scaled(p, *sheen, largest(color)));
  if (color != Vec3d(1.0)) add_rgb(set, "fuzz_color", color / largest(color));
}

/// Only for dielectrics: the specular colour of a metal is another one.
void add_specular_tint(PluginProperties& p, ParameterSet& set) {
  const Vec3d color = tint(p, "spec_tint");
  if (color == Vec3d(1.0)) return;
  const auto metallic = read_float(p, "metallic");
  if (metallic && (metallic->type == "texture" || metallic->numbers[0] > 0)) {
    warn_approximated(p, "\"spec_tint\" is ignored, as the surface is partly a metal");
    return;
  }
  add_float(set, "specular_weight", largest(color));
  add_rgb(set, "specular_color", color / largest(color));
}

MaterialDescription common(PluginProperties& p) {
  MaterialDescription m = material(p, "principled");
  add_color(m.parameters, "base_color", read_color(p, "base_color", ColorUse::kReflectance), 0.5);
  add_facets(p, m.parameters);
  copy_float(p, "spec_trans", m.parameters, "transmission_weight");
  add_sheen(p, m.parameters);
  add_specular_tint(p, m.parameters);
  if (constant(p, "flatness", 0) != 0) warn_approximated(p, "\"flatness\" is ignored");
  return m;
}

/// Mitsuba tints light by the root of the base colour at each interface, so that glass has the base
/// colour after two. "principled" tints by the whole transmission colour.
void add_transmission_color(PluginProperties& p, ParameterSet& set) {
  auto color = read_color(p, "base_color", ColorUse::kReflectance)
                   .value_or(constant_color(Vec3d(0.5), p.where()));
  Parameter& parameter = color.parameter;
  const bool is_rgb = parameter.type == "rgb", is_spectrum = parameter.type == "spectrum";
  if (!is_rgb && !is_spectrum)
    warn_approximated(p,
                      "its base colour tints light once where it enters and once where it leaves");
  // A spectrum has pairs of wavelength and value.
  for (size_t i = is_rgb ? 0 : 1; i < parameter.numbers.size(); i += is_rgb ? 1 : 2)
    parameter.numbers[i] = std::sqrt(std::max(parameter.numbers[i], 0.0));
  add_as(set, "transmission_color", std::move(parameter));
}

}  // namespace

Surface write_principled(PluginProperties& p) {
  MaterialDescription m = common(p);
  copy_float(p, "metallic", m.parameters, "base_metalness");
  const auto weight = read_float(p, "spec_trans");
  const bool transmits = weight && (weight->type == "texture" || weight->numbers[0] > 0);
  if (transmits) add_transmission_color(p, m.parameters);
  const double eta = p.has("eta") ? refraction_index(p, "eta", "pet")
                                  : index_of_specular(p.number("specular", 0.5));
  add_float(m.parameters, "specular_ior", eta);
  // The clearcoat has a quarter of a layer's reflectance, index 1.5 and its own roughness.
  const double gloss = constant(p, "clearcoat_gloss", 0);
  const auto coat = read_float(p, "clearcoat");
  if (coat && (coat->type == "texture" || coat->numbers[0] > 0)) {
    add_as(m.parameters, "coat_weight", scaled(p, *coat, 0.25));
    add_float(m.parameters, "coat_ior", 1.5);
    add_float(m.parameters, "coat_darkening", 0);
    add_bool(m.parameters, "coat_affects_specular", false);
    add_float(m.parameters, "coat_roughness", std::sqrt(std::lerp(0.1, 0.001, gloss)));
  }
  return surface_of(p, std::move(m), !transmits);
}

Surface write_thin_principled(PluginProperties& p) {
  MaterialDescription m = common(p);
  add_bool(m.parameters, "geometry_thin_walled", true);
  const auto color = read_color(p, "base_color", ColorUse::kReflectance);
  add_color(m.parameters, "transmission_color", color, 0.5);
  add_color(m.parameters, "diffuse_transmission_color", color, 0.5);
  // Mitsuba's "diff_trans" of 1 transmits half of the light, of 2 all of it.
  copy_float(p, "diff_trans", m.parameters, "diffuse_transmission_weight", 0.5);
  add_float(m.parameters, "specular_ior", p.has("eta") ? refraction_index(p, "eta", "pet") : 1.5);
  return surface_of(p, std::move(m), false);
}

}  // namespace nephroid::mitsuba
