// Smooth, thin and rough dielectrics, and the roughness of all microfacet BSDFs.
#include <cmath>

#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/refraction_index.h"
#include "input/mitsuba/value_text.h"

namespace nephroid::mitsuba {
namespace {

constexpr double kDefaultAlpha = 0.1;

void check_distribution(PluginProperties& p) {
  const std::string distribution = snake_case(p.text("distribution", "beckmann"));
  if (distribution != "ggx" && p.has("distribution") == false && !p.has("alpha") &&
      !p.has("alpha_u"))
    return;
  if (distribution != "ggx")
    warn_approximated(
        p, "distribution \"" + distribution + "\" is rendered as \"ggx\" of the same alpha");
}

Parameter alpha_of(PluginProperties& p, const char* name, const Parameter& fallback) {
  const auto found = read_float(p, name);
  if (found && found->type == "float" && !(found->numbers[0] >= 0 && found->numbers[0] <= 10))
    throw SceneError(found->where,
                     std::string("\"") + name + "\" is out of range, expected 0 to 10");
  return found.value_or(fallback);
}

bool is_white(const std::optional<ColorValue>& color) {
  return !color || (color->rgb && *color->rgb == Vec3d(1.0));
}

/// The material of the principled model with the colours of the dielectric.
MaterialDescription tinted(PluginProperties& p, double eta, bool is_rough,
                           const std::optional<ColorValue>& reflected,
                           const std::optional<ColorValue>& transmitted) {
  MaterialDescription m = material(p, "principled");
  add_float(m.parameters, "transmission_weight", 1);
  add_float(m.parameters, "specular_ior", eta);
  add_color(m.parameters, "specular_color", reflected, 1);
  add_color(m.parameters, "transmission_color", transmitted, 1);
  if (is_rough)
    add_principled_roughness(p, m.parameters);
  else
    add_float(m.parameters, "specular_roughness", 0);
  warn_approximated(p, "with colours of its own it is rendered as principled");
  return m;
}

Surface write_glass(PluginProperties& p, bool is_rough) {
  const double eta = relative_index(p, "bk7");
  const auto reflected = read_color(p, "specular_reflectance", ColorUse::kReflectance);
  const auto transmitted = read_color(p, "specular_transmittance", ColorUse::kReflectance);
  if (!is_white(reflected) || !is_white(transmitted))
    return surface_of(p, tinted(p, eta, is_rough, reflected, transmitted), false);
  MaterialDescription m = material(p, "dielectric");
  add_float(m.parameters, "eta", eta);
  if (is_rough) add_roughness(p, m.parameters);
  return surface_of(p, std::move(m), false);
}

}  // namespace

void add_roughness(PluginProperties& p, ParameterSet& set, const std::string& prefix) {
  check_distribution(p);
  const Parameter alpha =
      alpha_of(p, "alpha", numbers_parameter("float", "", {kDefaultAlpha}, p.where()));
  if (p.has("alpha_u") || p.has("alpha_v") || p.child("texture", "alpha_u") ||
      p.child("texture", "alpha_v")) {
    add_as(set, prefix + "uroughness", alpha_of(p, "alpha_u", alpha));
    add_as(set, prefix + "vroughness", alpha_of(p, "alpha_v", alpha));
  } else {
    add_as(set, prefix + "roughness", alpha);
  }
  add_bool(set, "remaproughness", false);
}

void add_principled_roughness(PluginProperties& p, ParameterSet& set) {
  ParameterSet alphas;
  alphas.where = p.where();
  add_roughness(p, alphas);
  double product = 1;
  int count = 0;
  for (const Parameter& alpha : alphas.list) {
    if (alpha.type == "texture") warn_approximated(p, "a texture of \"alpha\" is replaced by 0.1");
    if (alpha.type == "bool") continue;
    product *= alpha.type == "texture" ? kDefaultAlpha : alpha.numbers[0];
    ++count;
  }
  if (count == 2)
    warn_approximated(p, "\"alpha_u\" and \"alpha_v\" are replaced by their geometric mean");
  const double mean_alpha = count == 2 ? std::sqrt(product) : product;
  add_float(set, "specular_roughness", std::min(1.0, std::sqrt(mean_alpha)));
}

Surface write_dielectric(PluginProperties& p) {
  if (p.has("alpha") && p.number("alpha", 0) > 0)
    warn_approximated(p, "\"alpha\" is ignored, smooth glass has none");
  return write_glass(p, false);
}

Surface write_rough_dielectric(PluginProperties& p) {
  return write_glass(p, true);
}

Surface write_thin_dielectric(PluginProperties& p) {
  MaterialDescription m = material(p, "thindielectric");
  add_float(m.parameters, "eta", relative_index(p, "bk7"));
  if (!is_white(read_color(p, "specular_reflectance", ColorUse::kReflectance)) ||
      !is_white(read_color(p, "specular_transmittance", ColorUse::kReflectance)))
    warn_approximated(p, "colours of its own are ignored");
  return surface_of(p, std::move(m), false);
}

}  // namespace nephroid::mitsuba
