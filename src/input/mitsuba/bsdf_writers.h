// One function per BSDF of Mitsuba, and what they share.
#pragma once

#include <string>

#include "input/mitsuba/bsdf_plugins.h"
#include "input/mitsuba/color_value.h"
#include "input/mitsuba/parameter_values.h"

namespace nephroid::mitsuba {

using BsdfWriter = Surface (*)(PluginProperties& properties);

// bsdf_diffuse.cpp
Surface write_diffuse(PluginProperties& properties);
Surface write_rough_diffuse(PluginProperties& properties);
Surface write_diffuse_transmission(PluginProperties& properties);
Surface write_null(PluginProperties& properties);
Surface write_measured(PluginProperties& properties);
Surface write_hair(PluginProperties& properties);

// bsdf_dielectric.cpp
Surface write_dielectric(PluginProperties& properties);
Surface write_thin_dielectric(PluginProperties& properties);
Surface write_rough_dielectric(PluginProperties& properties);

// bsdf_conductor.cpp
Surface write_conductor(PluginProperties& properties);
Surface write_rough_conductor(PluginProperties& properties);

// bsdf_coated.cpp
Surface write_plastic(PluginProperties& properties);
Surface write_rough_plastic(PluginProperties& properties);
Surface write_coating(PluginProperties& properties);
Surface write_rough_coating(PluginProperties& properties);

// bsdf_lobes.cpp
Surface write_phong(PluginProperties& properties);
Surface write_ward(PluginProperties& properties);

// bsdf_adapters.cpp
Surface write_two_sided(PluginProperties& properties);
Surface write_mask(PluginProperties& properties);
Surface write_blend(PluginProperties& properties);
Surface write_mixture(PluginProperties& properties);
Surface write_bump_map(PluginProperties& properties);
Surface write_normal_map(PluginProperties& properties);

// bsdf_principled.cpp
Surface write_principled(PluginProperties& properties);
Surface write_thin_principled(PluginProperties& properties);

/// A material of that type at the place of the BSDF.
inline MaterialDescription material(PluginProperties& properties, const char* type) {
  return directive<MaterialDescription>(type, properties.where());
}
/// Adds the material to the scene and returns its name.
std::string add_material(PluginProperties& properties, MaterialDescription material);
/// The same as a surface.
Surface surface_of(PluginProperties& properties, MaterialDescription material, bool is_one_sided);

/// The mixture of two materials; `amount` is the share of the second, a float or a texture.
std::string mixture(PluginProperties& properties, const std::string& first,
                    const std::string& second, Parameter amount);

/// A number or a float texture, times a factor.
Parameter scaled(PluginProperties& properties, Parameter value, double factor);

/// Sets the microfacet distribution from "alpha", or "alpha_u" and "alpha_v", as parameters
/// `prefix` + "roughness". Warns of distributions other than GGX.
void add_roughness(PluginProperties& properties, ParameterSet& set, const std::string& prefix = "");
/// The same as specular_roughness of "principled" and its anisotropy.
void add_principled_roughness(PluginProperties& properties, ParameterSet& set);
/// An alpha, by default `fallback`. Throws SceneError if it is out of range.
Parameter read_alpha(PluginProperties& properties, const char* name, const Parameter& fallback);

/// The description of a written material.
const MaterialDescription& written_material(const ImportContext& context, const std::string& name);

}  // namespace nephroid::mitsuba
