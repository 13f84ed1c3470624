// The table of BSDFs, and the materials that they share.
#include "input/mitsuba/bsdf_plugins.h"

#include <iterator>
#include <stdexcept>

#include "input/mitsuba/bsdf_writers.h"

namespace nephroid::mitsuba {
namespace {

struct BsdfRow : Plugin {
  BsdfWriter write = nullptr;
};
using enum PluginSupport;
constexpr const char* kPolarized = "polarization is not supported";
constexpr BsdfRow kBsdfs[] = {
    {{"bsdf", "diffuse"}, write_diffuse},
    {{"bsdf", "roughdiffuse", kApproximated,
      "principled with the Oren-Nayar lobe of the same roughness"},
     write_rough_diffuse},
    {{"bsdf", "dielectric", kLoaded, "with colours of its own it becomes principled"},
     write_dielectric},
    {{"bsdf", "thindielectric", kLoaded, "colours of its own are ignored with a warning"},
     write_thin_dielectric},
    {{"bsdf", "roughdielectric", kLoaded,
      "other distributions than ggx are rendered as ggx of the same alpha, with a warning"},
     write_rough_dielectric},
    {{"bsdf", "conductor", kLoaded,
      "a specular_reflectance scales by its mean, with a warning if it is coloured"},
     write_conductor},
    {{"bsdf", "roughconductor", kLoaded,
      "other distributions than ggx are rendered as ggx of the same alpha, with a warning"},
     write_rough_conductor},
    {{"bsdf", "plastic", kLoaded, "coateddiffuse; principled if it is textured and linear"},
     write_plastic},
    {{"bsdf", "roughplastic", kLoaded, "coateddiffuse; principled if it is textured and linear"},
     write_rough_plastic},
    {{"bsdf", "coating", kApproximated,
      "conductors and diffuse surfaces get a coat, others stay without"},
     write_coating},
    {{"bsdf", "roughcoating", kApproximated,
      "conductors and diffuse surfaces get a coat, others stay without"},
     write_rough_coating},
    {{"bsdf", "bumpmap"}, write_bump_map},
    {{"bsdf", "normalmap", kLoaded, "its texture must be a bitmap"}, write_normal_map},
    {{"bsdf", "mask", kLoaded, "opacity of the shape; a coloured one is replaced by its mean"},
     write_mask},
    {{"bsdf", "blendbsdf"}, write_blend},
    {{"bsdf", "mixturebsdf", kLoaded, "weights with a sum below 1 absorb the rest"}, write_mixture},
    {{"bsdf", "twosided", kLoaded,
      "all surfaces are two-sided here; with two BSDFs the first one is on both sides"},
     write_two_sided},
    {{"bsdf", "phong", kApproximated,
      "a mixture of diffuse and of a mirror with a ggx lobe of the same width"},
     write_phong},
    {{"bsdf", "ward", kApproximated,
      "a mixture of diffuse and of a mirror with a ggx lobe of the same alpha"},
     write_ward},
    {{"bsdf", "difftrans"}, write_diffuse_transmission},
    {{"bsdf", "null"}, write_null},
    {{"bsdf", "principled", kApproximated,
      "the OpenPBR material of the same parameters; a textured base_color tints transmitted light "
      "once too often"},
     write_principled},
    {{"bsdf", "principledthin", kApproximated,
      "the thin-walled OpenPBR material of the same parameters"},
     write_thin_principled},
    {{"bsdf", "measured", kLoaded, "an RGL .bsdf file"}, write_measured},
    {{"bsdf", "hair"}, write_hair},
    {{"bsdf", "pplastic", kApproximated, "plastic without polarization"}, write_rough_plastic},
    {{"bsdf", "hk", kRefused, "layers that scatter inside are not supported"}},
    {{"bsdf", "irawan", kRefused, "woven cloth is not supported"}},
    {{"bsdf", "polarizer", kRefused, kPolarized}},
    {{"bsdf", "retarder", kRefused, kPolarized}},
    {{"bsdf", "circular", kRefused, kPolarized}},
    {{"bsdf", "measured_polarized", kRefused, kPolarized}},
};

/// Materials that are no object of the scene, under a name that no object can take.
std::string shared_material(ImportContext& context, const std::string& name, const char* type,
                            const SourceLocation& where) {
  for (const MaterialDescription& m : context.scene.materials)
    if (m.name == name) return name;
  MaterialDescription m = directive<MaterialDescription>(type, where);
  m.name = name;
  if (m.type == "diffuse") add_rgb(m.parameters, "reflectance", Vec3d(0.0));
  context.scene.materials.push_back(std::move(m));
  return name;
}

}  // namespace

Surface write_bsdf(ImportContext& context, const Object& object) {
  const auto known = context.surfaces.find(&object);
  if (known != context.surfaces.end()) return known->second;
  PluginProperties properties(object, context);
  const Surface surface = plugin_row(kBsdfs, object, context.diagnostics).write(properties);
  properties.report_unused();
  return context.surfaces[&object] = surface;
}

std::string black_material(ImportContext& context, const SourceLocation& where) {
  return shared_material(context, " black", "diffuse", where);
}

std::string null_material(ImportContext& context, const SourceLocation& where) {
  return shared_material(context, " null", "interface", where);
}

std::string add_material(PluginProperties& properties, MaterialDescription material) {
  material.name = properties.context().unique_name(properties.object());
  properties.context().scene.materials.push_back(std::move(material));
  return properties.context().scene.materials.back().name;
}

Surface surface_of(PluginProperties& properties, MaterialDescription material, bool is_one_sided) {
  Surface surface;
  surface.material = add_material(properties, std::move(material));
  surface.is_one_sided = is_one_sided;
  return surface;
}

std::string mixture(PluginProperties& properties, const std::string& first,
                    const std::string& second, Parameter amount) {
  MaterialDescription m = material(properties, "mix");
  m.parameters.list.push_back(
      text_parameter("string", "materials", {first, second}, properties.where()));
  add_as(m.parameters, "amount", std::move(amount));
  return add_material(properties, std::move(m));
}

Parameter scaled(PluginProperties& properties, Parameter value, double factor) {
  if (factor == 1) return value;
  if (value.type == "float") {
    value.numbers[0] *= factor;
    return value;
  }
  TextureDescription t = directive<TextureDescription>("scale", properties.where());
  t.name = properties.context().unique_name(properties.object());
  t.value_type = "float";
  add_as(t.parameters, "tex", std::move(value));
  add_float(t.parameters, "scale", factor);
  properties.context().scene.textures.push_back(t);
  return text_parameter("texture", "", {t.name}, properties.where());
}

const MaterialDescription& written_material(const ImportContext& context, const std::string& name) {
  for (const MaterialDescription& m : context.scene.materials)
    if (m.name == name) return m;
  throw std::logic_error("material \"" + name + "\" was not written");
}

std::vector<Plugin> bsdf_plugins() {
  return std::vector<Plugin>(std::begin(kBsdfs), std::end(kBsdfs));
}

}  // namespace nephroid::mitsuba
