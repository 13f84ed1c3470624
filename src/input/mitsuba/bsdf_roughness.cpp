// The roughness of all microfacet BSDFs.
#include <algorithm>
#include <cmath>

#include "input/mitsuba/bsdf_writers.h"
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

bool is_given(PluginProperties& p, const char* name) {
  return p.has(name) || p.child("texture", name);
}

/// alpha, twice the same unless the facets are anisotropic.
struct Alphas {
  Parameter u, v;
  bool differ = false;
};

Alphas read_alphas(PluginProperties& p) {
  check_distribution(p);
  const Parameter alpha =
      read_alpha(p, "alpha", numbers_parameter("float", "", {kDefaultAlpha}, p.where()));
  if (!is_given(p, "alpha_u") && !is_given(p, "alpha_v")) return {alpha, alpha};
  return {read_alpha(p, "alpha_u", alpha), read_alpha(p, "alpha_v", alpha), true};
}

/// The facets of "principled" with two alphas, which are wider along dpdu (OpenPBR 1.1).
void add_two_alphas(PluginProperties& p, ParameterSet& set, double u, double v) {
  add_float(set, "specular_roughness", std::sqrt(0.5 * (u * u + v * v)));
  if (v > u)
    warn_approximated(p, "\"alpha_v\" is above \"alpha_u\", both are replaced by their mean");
  else if (u > 0)
    add_float(set, "specular_roughness_anisotropy", 1 - v / u);
}

}  // namespace

Parameter read_alpha(PluginProperties& p, const char* name, const Parameter& fallback) {
  const auto found = read_float(p, name);
  if (found && found->type == "float" && !(found->numbers[0] >= 0 && found->numbers[0] <= 10))
    throw SceneError(found->where,
                     std::string("\"") + name + "\" is out of range, expected 0 to 10");
  return found.value_or(fallback);
}

void add_roughness(PluginProperties& p, ParameterSet& set, const std::string& prefix) {
  const Alphas alphas = read_alphas(p);
  if (alphas.differ) {
    add_as(set, prefix + "uroughness", alphas.u);
    add_as(set, prefix + "vroughness", alphas.v);
  } else {
    add_as(set, prefix + "roughness", alphas.u);
  }
  add_bool(set, "remaproughness", false);
}

void add_principled_roughness(PluginProperties& p, ParameterSet& set) {
  const Alphas alphas = read_alphas(p);
  if (alphas.differ && alphas.u.type == "float" && alphas.v.type == "float") {
    add_two_alphas(p, set, alphas.u.numbers[0], alphas.v.numbers[0]);
  } else {
    if (alphas.differ)
      warn_approximated(p, "\"alpha_u\" counts for \"alpha_v\", too, as one is a texture");
    add_as(set, "specular_roughness", alphas.u);
  }
  add_bool(set, "remaproughness", false);
}

}  // namespace nephroid::mitsuba
