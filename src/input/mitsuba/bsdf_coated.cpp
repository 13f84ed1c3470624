// Plastics, and coats over other BSDFs.
#include <algorithm>

#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/refraction_index.h"

namespace nephroid::mitsuba {
namespace {

/// In mean free paths: so thin that the coat itself absorbs nothing.
constexpr double kClearThickness = 1e-6;
/// Events between base and coat: bright plastics need many.
constexpr int kMaxCoatDepth = 100;

/// The base whose interreflection with the coat gives the reflectance of Mitsuba's linear plastic,
/// which leaves the colour out of the sum: b / (1 - b F) = r / (1 - F).
double base_of(double reflectance, double f) {
  return reflectance / (1 - f + reflectance * f);
}

ColorValue linear_base(const ColorValue& reflectance, double eta) {
  const double f = internal_diffuse_reflectance(eta);
  const Vec3d& r = *reflectance.rgb;
  return constant_color(Vec3d(base_of(r.x, f), base_of(r.y, f), base_of(r.z, f)),
                        reflectance.parameter.where);
}

/// Diffuse light below a coat in the principled model, which is linear in the base colour, too.
MaterialDescription principled_plastic(PluginProperties& p, double eta, bool is_rough,
                                       const ColorValue& diffuse,
                                       const std::optional<ColorValue>& specular) {
  MaterialDescription m = material(p, "principled");
  add_as(m.parameters, "base_color", diffuse.parameter);
  add_float(m.parameters, "specular_ior", eta);
  if (specular) add_as(m.parameters, "specular_color", specular->parameter);
  if (is_rough)
    add_principled_roughness(p, m.parameters);
  else
    add_float(m.parameters, "specular_roughness", 0);
  return m;
}

Surface write_coated_diffuse(PluginProperties& p, bool is_rough) {
  const double eta = relative_index(p, "polypropylene");
  const bool nonlinear = p.boolean("nonlinear", false);
  const ColorValue diffuse = read_color(p, "diffuse_reflectance", ColorUse::kReflectance)
                                 .value_or(constant_color(Vec3d(0.5), p.where()));
  const auto specular = read_color(p, "specular_reflectance", ColorUse::kReflectance);
  const bool is_tinted = specular && !(specular->rgb && *specular->rgb == Vec3d(1.0));
  if (is_tinted || (!nonlinear && !diffuse.rgb))
    return surface_of(p, principled_plastic(p, eta, is_rough, diffuse, specular), true);
  MaterialDescription m = material(p, "coateddiffuse");
  add_color(m.parameters, "reflectance", nonlinear ? diffuse : linear_base(diffuse, eta), 0.5);
  add_float(m.parameters, "eta", eta);
  add_float(m.parameters, "thickness", kClearThickness);
  add_integer(m.parameters, "maxdepth", kMaxCoatDepth);
  if (is_rough) add_roughness(p, m.parameters);
  return surface_of(p, std::move(m), true);
}

/// Absorption inside of the coat, in mean free paths.
double optical_thickness(PluginProperties& p) {
  const double thickness = p.number("thickness", 1);
  const Vec3d sigma = read_rgb(p, "sigma_a").value_or(Vec3d(0.0));
  if (sigma.x != sigma.y || sigma.y != sigma.z)
    warn_approximated(p, "a coloured \"sigma_a\" is replaced by its mean");
  return std::max(kClearThickness, mean(sigma) * thickness);
}

/// Copies a parameter of the base under another name.
void take(const ParameterSet& from, const std::string& name, ParameterSet& to,
          const std::string& as) {
  for (const Parameter& parameter : from.list)
    if (parameter.name == name) add_as(to, as, parameter);
}

MaterialDescription coated_conductor(PluginProperties& p, const ParameterSet& base) {
  MaterialDescription m = material(p, "coatedconductor");
  for (const char* name : {"eta", "k", "roughness", "uroughness", "vroughness"})
    take(base, name, m.parameters, std::string("conductor.") + name);
  take(base, "reflectance", m.parameters, "reflectance");
  return m;
}

Surface write_coat(PluginProperties& p, bool is_rough) {
  const Object* nested = p.first_child("bsdf");
  if (!nested) throw SceneError(p.where(), p.title() + " has no BSDF in it, expected one");
  Surface surface = write_bsdf(p.context(), *nested);
  const MaterialDescription base = written_material(p.context(), surface.material);
  const double eta = relative_index(p, "bk7"), thickness = optical_thickness(p);
  if (p.has("specular_reflectance")) warn_approximated(p, "\"specular_reflectance\" is ignored");
  MaterialDescription m;
  std::string prefix;
  if (base.type == "conductor") {
    m = coated_conductor(p, base.parameters);
    prefix = "interface.";
  } else if (base.type == "diffuse") {
    m = material(p, "coateddiffuse");
    take(base.parameters, "reflectance", m.parameters, "reflectance");
  } else {
    warn_approximated(p, "the coat is left out, the BSDF in it is rendered alone");
    return surface;
  }
  add_float(m.parameters, prefix + "eta", eta);
  add_float(m.parameters, "thickness", thickness);
  add_integer(m.parameters, "maxdepth", kMaxCoatDepth);
  if (is_rough)
    add_roughness(p, m.parameters, prefix);
  else
    add_bool(m.parameters, "remaproughness", false);
  surface.material = add_material(p, std::move(m));
  return surface;
}

}  // namespace

Surface write_plastic(PluginProperties& p) {
  return write_coated_diffuse(p, false);
}

Surface write_rough_plastic(PluginProperties& p) {
  return write_coated_diffuse(p, true);
}

Surface write_coating(PluginProperties& p) {
  return write_coat(p, false);
}

Surface write_rough_coating(PluginProperties& p) {
  return write_coat(p, true);
}

}  // namespace nephroid::mitsuba
