// Smooth, thin and rough dielectrics.
#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/refraction_index.h"

namespace nephroid::mitsuba {
namespace {

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
