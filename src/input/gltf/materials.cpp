#include "input/gltf/materials.h"

#include <algorithm>
#include <cmath>

#include "input/gltf/surface_inputs.h"

namespace nephroid::gltf {
namespace {

Color times(const Color& c, double factor) {
  return {c[0] * factor, c[1] * factor, c[2] * factor};
}

/// Base colour and alpha of either workflow.
struct BaseColor {
  std::optional<JsonValue> texture;
  std::array<double, 4> factor{1, 1, 1, 1};
};

BaseColor base_color(const JsonValue& owner, const std::string& factor,
                     const std::string& texture) {
  return {owner.find_object(texture), owner.get_numbers<4>(factor, {1, 1, 1, 1})};
}

/// The "alpha" of shapes, by the material's alpha mode.
void add_alpha(SurfaceInputs& inputs, const BaseColor& base) {
  if (!inputs.json) return;
  const std::string mode = inputs.json->get_text("alphaMode", "OPAQUE");
  if (mode == "OPAQUE") return;
  NumberLookup lookup{'a', base.factor[3], false, {}, inputs.has_vertex_colors};
  if (mode == "MASK")
    lookup.cutoff = inputs.json->get_number("alphaCutoff", 0.5);
  else if (mode != "BLEND")
    inputs.json->get("alphaMode")
        .fail("unknown mode \"" + mode + "\", expected OPAQUE, MASK or BLEND");
  ParameterList& shape = inputs.surface.shape_parameters;
  if (base.texture) {
    shape.add_texture("alpha",
                      inputs.textures.number(*base.texture, lookup, inputs.surface.uv_sets));
  } else if (inputs.has_vertex_colors) {
    shape.add_texture("alpha", inputs.textures.vertex_alpha(lookup, inputs.where()));
  } else {
    double alpha = base.factor[3];
    if (lookup.cutoff) alpha = alpha >= *lookup.cutoff ? 1 : 0;
    if (alpha < 1) shape.add_float("alpha", alpha);
  }
  if (inputs.has_vertex_colors) inputs.surface.uses_vertex_colors = true;
}

/// The area light of shapes for a colour. An image lies over the first set of texture coordinates.
void add_area_light(SurfaceInputs& inputs, const Color& factor,
                    const std::optional<JsonValue>& texture, const SourceLocation& where) {
  if (largest(factor) <= 0) return;
  ParameterList list(where);
  if (texture) {
    inputs.textures.add_placed_image(list, "filename", "", *texture, inputs.surface.uv_sets);
    list.add_color("factor", factor);
  } else {
    list.add_color("L", factor);
  }
  if (inputs.json->get_flag("doubleSided", false)) list.add_bool("twosided", true);
  const std::string name = inputs.json->get_text("name", "");
  if (!name.empty()) list.add_string("name", name);
  inputs.surface.area_light = std::move(list).directive("diffuse");
}

void add_emission(SurfaceInputs& inputs) {
  if (!inputs.json) return;
  const ColorInput emission =
      SurfaceInputs::color(*inputs.json, "emissiveFactor", kBlack, "emissiveTexture");
  double strength = 1;
  if (const auto extension = inputs.extension("KHR_materials_emissive_strength"))
    strength = extension->get_number("emissiveStrength", 1);
  add_area_light(inputs, times(emission.factor, strength), emission.texture, inputs.json->where());
}

/// A surface that shows its base colour whatever the light: it emits that colour and scatters none.
void make_unlit(SurfaceInputs& inputs, const BaseColor& base) {
  inputs.warn(inputs.where(),
              "KHR_materials_unlit: the surface emits its base colour, and so it lights others");
  add_area_light(inputs, {base.factor[0], base.factor[1], base.factor[2]}, base.texture,
                 inputs.where());
  if (inputs.has_vertex_colors) {
    inputs.surface.emits_vertex_colors = true;
    inputs.warn(inputs.where(),
                "KHR_materials_unlit: a lamp has one colour or an image, so the colours of "
                "vertices are replaced by their mean over each primitive");
  }
  inputs.list.add_color("base_color", kBlack);
  inputs.list.add_float("specular_weight", 0);
}

void add_normal_map(SurfaceInputs& inputs) {
  if (!inputs.json) return;
  const std::optional<JsonValue> info = inputs.json->find_object("normalTexture");
  if (!info) return;
  if (inputs.surface.uv_sets.place_of(uv_set_of(*info)).value_or(0) != 0)
    inputs.warn(info->where(),
                "the normal map and the emission use different sets of texture "
                "coordinates: the tangents of the normal map follow the set of the emission");
  inputs.textures.add_placed_image(inputs.list, "normalmap", "normalmap.", *info,
                                   inputs.surface.uv_sets);
  const double scale = info->get_number("scale", 1);
  if (scale != 1) inputs.list.add_float("normalmap.scale", scale);
  inputs.list.add_bool("normalmap.handedness", true);
  inputs.surface.needs_tangents = true;
}

/// KHR_materials_pbrSpecularGlossiness: diffuse below a dielectric whose normal reflectance is the
/// specular colour, so its index is that of the largest component.
void add_specular_glossiness(SurfaceInputs& inputs, const JsonValue& extension) {
  inputs.warn(extension.where(),
              "KHR_materials_pbrSpecularGlossiness is approximated by a dielectric of that "
              "reflectance");
  inputs.add("base_color", inputs.base);
  ColorInput specular =
      SurfaceInputs::color(extension, "specularFactor", kWhite, "specularGlossinessTexture");
  const double reflectance = std::clamp(largest(specular.factor), 0.0, 1.0);
  if (reflectance > 0) {
    add_reflectance(inputs, reflectance, NumberInput());
    specular.factor = times(specular.factor, 1 / largest(specular.factor));
    inputs.add("specular_color", specular);
  } else {
    inputs.list.add_float("specular_weight", 0);
  }
  const NumberInput gloss =
      SurfaceInputs::number(extension, "glossinessFactor", 1, "specularGlossinessTexture", 'a');
  if (gloss.texture)
    inputs.list.add_texture(
        "specular_roughness",
        inputs.textures.number(*gloss.texture, {'a', gloss.factor, true, {}, false},
                               inputs.surface.uv_sets));
  else
    inputs.list.add_float("specular_roughness", 1 - gloss.factor);
}

void add_metallic_roughness(SurfaceInputs& inputs) {
  std::optional<JsonValue> pbr;
  if (inputs.json) pbr = inputs.json->find_object("pbrMetallicRoughness");
  NumberInput metalness{{}, 'b', 1}, roughness{{}, 'g', 1};
  if (pbr) {
    metalness = SurfaceInputs::number(*pbr, "metallicFactor", 1, "metallicRoughnessTexture", 'b');
    roughness = SurfaceInputs::number(*pbr, "roughnessFactor", 1, "metallicRoughnessTexture", 'g');
  }
  inputs.add("base_color", inputs.base);
  inputs.add("base_metalness", metalness);
  if (const auto anisotropy = inputs.extension("KHR_materials_anisotropy")) {
    // A mirror is stretched, too, from the least roughness that counts.
    constexpr double kMinRoughness = 0.01;
    if (!roughness.texture && anisotropy->get_number("anisotropyStrength", 0) > 0)
      roughness.factor = std::max(roughness.factor, kMinRoughness);
    add_anisotropy(inputs, roughness);
  } else {
    inputs.add("specular_roughness", roughness);
  }
  add_specular(inputs);
  add_transmission(inputs);
  add_diffuse_transmission(inputs);
  add_clearcoat(inputs);
  add_sheen(inputs);
  add_iridescence(inputs);
}

BaseColor read_base_color(const SurfaceInputs& inputs) {
  if (const auto glossy = inputs.extension("KHR_materials_pbrSpecularGlossiness"))
    return base_color(*glossy, "diffuseFactor", "diffuseTexture");
  if (!inputs.json) return {};
  const std::optional<JsonValue> pbr = inputs.json->find_object("pbrMetallicRoughness");
  return pbr ? base_color(*pbr, "baseColorFactor", "baseColorTexture") : BaseColor();
}

void describe(SurfaceInputs& inputs) {
  const BaseColor base = read_base_color(inputs);
  inputs.base = {
      base.texture, {base.factor[0], base.factor[1], base.factor[2]}, inputs.has_vertex_colors};
  if (inputs.extension("KHR_materials_unlit")) {
    make_unlit(inputs, base);
  } else {
    // Emission first: its image uses the first set of texture coordinates. The directions of normal
    // maps come from the first set, too.
    add_emission(inputs);
    add_normal_map(inputs);
    const auto glossy = inputs.extension("KHR_materials_pbrSpecularGlossiness");
    if (glossy)
      add_specular_glossiness(inputs, *glossy);
    else
      add_metallic_roughness(inputs);
  }
  add_alpha(inputs, base);
}

}  // namespace

std::optional<size_t> Materials::chosen_variant() {
  const std::string& wanted = document_.options().variant;
  if (wanted.empty()) return std::nullopt;
  const std::vector<std::string>& variants = scene_.choices.variants;
  std::string known;
  for (size_t i = 0; i < variants.size(); ++i) {
    if (variants[i] == wanted) return i;
    known += (known.empty() ? "\"" : ", \"") + variants[i] + "\"";
  }
  document_.root().fail(
      "there is no material variant \"" + wanted + "\"" +
      (known.empty() ? ": the file has no variants" : ", expected one of " + known));
}

std::optional<size_t> Materials::material_index(const JsonValue& primitive) {
  const std::optional<size_t> variant = chosen_variant();
  const auto extension = primitive.extension("KHR_materials_variants");
  if (variant && extension)
    for (const JsonValue& mapping : extension->get("mappings").elements())
      for (const JsonValue& number : mapping.get("variants").elements())
        if (number.index() == *variant) return mapping.get_index("material");
  return primitive.find_index("material");
}

std::string Materials::unique_name(const std::optional<JsonValue>& material) {
  const std::string name = material ? material->get_text("name", "material") : "default";
  int& uses = names_[name];
  if (++uses == 1) return name;
  std::string numbered = name + "." + std::to_string(uses);
  while (names_.contains(numbered)) numbered = name + "." + std::to_string(++uses);
  names_[numbered] = 1;
  return numbered;
}

SurfaceDescription Materials::make(const std::optional<JsonValue>& material,
                                   bool has_vertex_colors) {
  const SourceLocation where = material ? material->where() : document_.root().where();
  SurfaceInputs inputs{document_,
                       scene_,
                       textures_,
                       material,
                       has_vertex_colors,
                       ParameterList(where),
                       SurfaceDescription(),
                       ColorInput()};
  inputs.surface.shape_parameters = ParameterList(where);
  describe(inputs);
  MaterialDescription description;
  static_cast<DirectiveDescription&>(description) = std::move(inputs.list).directive("principled");
  description.name = unique_name(material);
  inputs.surface.material.index = static_cast<int>(scene_.materials.size());
  inputs.surface.material.where = where;
  scene_.materials.push_back(std::move(description));
  return std::move(inputs.surface);
}

const SurfaceDescription& Materials::surface_of(const JsonValue& primitive,
                                                bool has_vertex_colors) {
  const std::optional<size_t> index = material_index(primitive);
  const std::pair<int64_t, bool> key{index ? static_cast<int64_t>(*index) : -1, has_vertex_colors};
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  std::optional<JsonValue> material;
  if (index) material = document_.item("materials", *index, primitive);
  return known_.emplace(key, make(material, has_vertex_colors)).first->second;
}

}  // namespace nephroid::gltf
