// Extensions of glTF materials in the terms of OpenPBR; see surface_inputs.h.
#include <algorithm>
#include <cmath>

#include "input/gltf/surface_inputs.h"

namespace nephroid::gltf {
namespace {

/// The medium in a volume: after `distance` it leaves `color` of white light.
std::string add_interior(SurfaceInputs& inputs, const JsonValue& volume, const Color& color,
                         double distance) {
  // A channel that leaves nothing would need infinite absorption.
  constexpr double kDarkest = 1e-6;
  Color absorption;
  for (size_t i = 0; i < 3; ++i)
    absorption[i] = -std::log(std::clamp(color[i], kDarkest, 1.0)) / distance;
  ParameterList list(volume.where());
  list.add_color("sigma_a", absorption);
  list.add_color("sigma_s", kBlack);
  MediumDescription medium;
  static_cast<DirectiveDescription&>(medium) = std::move(list).directive("homogeneous");
  medium.name = "interior " + std::to_string(inputs.scene.media.size());
  inputs.scene.media.push_back(medium);
  return medium.name;
}

/// Adds the interior of a volume. Returns true if the material encloses one.
bool add_volume(SurfaceInputs& inputs) {
  const auto volume = inputs.extension("KHR_materials_volume");
  // The thickness is for rasterizers: here only a thickness of 0 counts, which says thin.
  const double thickness = volume ? volume->get_number("thicknessFactor", 0) : 0;
  const bool is_solid = thickness > 0 || inputs.document.options().solid_glass;
  if (!volume || !is_solid) return is_solid;
  const Color color = volume->get_numbers<3>("attenuationColor", kWhite);
  const double distance = volume->get_number("attenuationDistance", 0);
  if (distance > 0 && color != kWhite)
    inputs.surface.interior = add_interior(inputs, *volume, color, distance);
  return true;
}

/// True if both have the same image at the same place, or none has one.
bool is_same_map(const std::optional<JsonValue>& a, const std::optional<JsonValue>& b) {
  return a && b ? a->is_equal(*b) : !a && !b;
}

/// The facets of OpenPBR.
struct StretchedFacets {
  double roughness, anisotropy;
};

/// glTF stretches the tangent's alpha from a = roughness^2 to a + (1 - a) strength^2. OpenPBR has
/// alpha_t = r^2 sqrt(2 / (1 + (1 - s)^2)) and alpha_b = (1 - s) alpha_t; solved for r and s.
StretchedFacets stretched(double roughness, double strength) {
  const double across = roughness * roughness;
  const double along = across + (1 - across) * strength * strength;
  const double ratio = across / along;
  return {std::sqrt(along / std::sqrt(2 / (1 + ratio * ratio))), 1 - ratio};
}

}  // namespace

void add_transmission(SurfaceInputs& inputs) {
  const auto transmission = inputs.extension("KHR_materials_transmission");
  if (!transmission) return;
  const NumberInput weight =
      SurfaceInputs::number(*transmission, "transmissionFactor", 0, "transmissionTexture", 'r');
  if (weight.factor == 0) return;
  inputs.add("transmission_weight", weight);
  inputs.add("transmission_color", inputs.base);
  if (!add_volume(inputs)) {
    inputs.list.add_bool("geometry_thin_walled", true);
    inputs.warn(
        transmission->where(),
        "transmission without KHR_materials_volume is thin by the specification, so this "
        "glass bends no light and casts no caustic of its own (--solid-glass makes it solid)");
    return;
  }
  if (const auto dispersion = inputs.extension("KHR_materials_dispersion")) {
    // The extension stores 20 / V, V the Abbe number.
    const double value = dispersion->get_number("dispersion", 0);
    if (value > 0) inputs.list.add_float("transmission_dispersion_abbe_number", 20 / value);
  }
}

void add_diffuse_transmission(SurfaceInputs& inputs) {
  const auto extension = inputs.extension("KHR_materials_diffuse_transmission");
  if (!extension) return;
  const NumberInput weight = SurfaceInputs::number(*extension, "diffuseTransmissionFactor", 0,
                                                   "diffuseTransmissionTexture", 'a');
  // Specular transmission has made the interior already.
  if (weight.factor > 0 && inputs.surface.interior.empty()) add_volume(inputs);
  inputs.add("diffuse_transmission_weight", weight);
  inputs.add("diffuse_transmission_color",
             SurfaceInputs::color(*extension, "diffuseTransmissionColorFactor", kWhite,
                                  "diffuseTransmissionColorTexture"));
}

void add_reflectance(SurfaceInputs& inputs, double reflectance, NumberInput weight) {
  // The largest index that the material takes, and its reflectance ((n - 1) / (n + 1))^2.
  constexpr double kMaxIndex = 10, kMaxReflectance = 81.0 / 121.0;
  if (reflectance < kMaxReflectance) {
    const double root = std::sqrt(reflectance);
    inputs.list.add_float("specular_ior", (1 + root) / (1 - root));
  } else {
    inputs.list.add_float("specular_ior", kMaxIndex);
    weight.factor *= reflectance / kMaxReflectance;
  }
  if (weight.texture || weight.factor != 1) inputs.add("specular_weight", weight);
}

void add_specular(SurfaceInputs& inputs) {
  const auto specular = inputs.extension("KHR_materials_specular");
  NumberInput weight;
  if (specular)
    weight = SurfaceInputs::number(*specular, "specularFactor", 1, "specularTexture", 'a');
  double index = 1.5;
  if (const auto ior = inputs.extension("KHR_materials_ior")) index = ior->get_number("ior", 1.5);
  if (index == 0) {
    add_reflectance(inputs, 1, weight);  // so the specification says
  } else {
    inputs.list.add_float("specular_ior", index);
    if (specular) inputs.add("specular_weight", weight);
  }
  if (!specular) return;
  inputs.add("specular_color", SurfaceInputs::color(*specular, "specularColorFactor", kWhite,
                                                    "specularColorTexture"));
}

void add_clearcoat(SurfaceInputs& inputs) {
  const auto coat = inputs.extension("KHR_materials_clearcoat");
  if (!coat) return;
  const NumberInput weight =
      SurfaceInputs::number(*coat, "clearcoatFactor", 0, "clearcoatTexture", 'r');
  if (weight.factor == 0) return;
  inputs.add("coat_weight", weight);
  inputs.add("coat_roughness", SurfaceInputs::number(*coat, "clearcoatRoughnessFactor", 0,
                                                     "clearcoatRoughnessTexture", 'g'));
  inputs.list.add_float("coat_ior", 1.5);
  // glTF's coat neither darkens what is below nor changes its F0 and roughness.
  inputs.list.add_float("coat_darkening", 0);
  inputs.list.add_bool("coat_affects_specular", false);
  const auto map = coat->find_object("clearcoatNormalTexture");
  if (!is_same_map(map, inputs.json->find_object("normalTexture")))
    inputs.warn(map ? map->where() : coat->where(),
                "the coat and the surface below have different normal maps: both get the one of "
                "the surface below");
}

void add_sheen(SurfaceInputs& inputs) {
  const auto sheen = inputs.extension("KHR_materials_sheen");
  if (!sheen) return;
  ColorInput color = SurfaceInputs::color(*sheen, "sheenColorFactor", kBlack, "sheenColorTexture");
  const double weight = largest(color.factor);
  if (weight <= 0) return;
  // Both models dim what is below by the largest component of the colour.
  for (double& component : color.factor) component /= weight;
  inputs.list.add_float("fuzz_weight", std::min(weight, 1.0));
  inputs.add("fuzz_color", color);
  inputs.add("fuzz_roughness", SurfaceInputs::number(*sheen, "sheenRoughnessFactor", 0,
                                                     "sheenRoughnessTexture", 'a'));
}

void add_anisotropy(SurfaceInputs& inputs, const NumberInput& roughness) {
  const auto extension = inputs.extension("KHR_materials_anisotropy");
  const NumberInput strength =
      SurfaceInputs::number(*extension, "anisotropyStrength", 0, "anisotropyTexture", 'b');
  inputs.surface.needs_tangents = true;
  inputs.surface.uv_sets.place_of(0);
  inputs.surface.tangent_rotation = extension->get_number("anisotropyRotation", 0);
  if (strength.texture)
    inputs.warn(strength.texture->where(),
                "an anisotropy texture is approximated: its strength counts, its directions do "
                "not");
  if (roughness.texture || roughness.factor == 0) {
    if (roughness.texture)
      inputs.warn(extension->where(), "anisotropy below a texture of roughness is approximated");
    inputs.add("specular_roughness", roughness);
    inputs.add("specular_roughness_anisotropy", strength);
    return;
  }
  const StretchedFacets all = stretched(roughness.factor, strength.factor);
  if (!strength.texture || strength.factor == 0) {
    inputs.list.add_float("specular_roughness", all.roughness);
    inputs.list.add_float("specular_roughness_anisotropy", all.anisotropy);
    return;
  }
  const SourceLocation where = strength.texture->where();
  const std::string amount =
      inputs.textures.number(*strength.texture, {'b', 1, false, {}, false}, inputs.surface.uv_sets);
  inputs.list.add_texture("specular_roughness",
                          inputs.textures.mix(roughness.factor, all.roughness, amount, where));
  inputs.list.add_texture("specular_roughness_anisotropy",
                          inputs.textures.mix(0, all.anisotropy, amount, where));
}

void add_iridescence(SurfaceInputs& inputs) {
  const auto film = inputs.extension("KHR_materials_iridescence");
  if (!film) return;
  const NumberInput weight =
      SurfaceInputs::number(*film, "iridescenceFactor", 0, "iridescenceTexture", 'r');
  if (weight.factor == 0) return;
  constexpr double kMicrometres = 1e-3;  // per nanometre
  const double thinnest = film->get_number("iridescenceThicknessMinimum", 100) * kMicrometres;
  const double thickest = film->get_number("iridescenceThicknessMaximum", 400) * kMicrometres;
  inputs.add("thin_film_weight", weight);
  inputs.list.add_float("thin_film_ior", film->get_number("iridescenceIor", 1.3));
  if (const auto map = film->find_object("iridescenceThicknessTexture"))
    inputs.list.add_texture(
        "thin_film_thickness",
        inputs.textures.mix(
            thinnest, thickest,
            inputs.textures.number(*map, {'g', 1, false, {}, false}, inputs.surface.uv_sets),
            map->where()));
  else
    inputs.list.add_float("thin_film_thickness", thickest);
}

}  // namespace nephroid::gltf
