// BSDFs without a microfacet lobe: diffuse ones, null, measured and hair.
#include <algorithm>
#include <cmath>

#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/refraction_index.h"

namespace nephroid::mitsuba {
namespace {

/// "reflectance", which Mitsuba 0.5 also calls "diffuse_reflectance".
std::optional<ColorValue> reflectance(PluginProperties& p) {
  auto color = read_color(p, "reflectance", ColorUse::kReflectance);
  return color ? color : read_color(p, "diffuse_reflectance", ColorUse::kReflectance);
}

}  // namespace

Surface write_diffuse(PluginProperties& p) {
  MaterialDescription m = material(p, "diffuse");
  add_color(m.parameters, "reflectance", reflectance(p), 0.5);
  return surface_of(p, std::move(m), true);
}

Surface write_rough_diffuse(PluginProperties& p) {
  MaterialDescription m = material(p, "principled");
  add_color(m.parameters, "base_color", reflectance(p), 0.5);
  add_float(m.parameters, "specular_weight", 0);
  const Parameter alpha =
      read_float(p, "alpha").value_or(numbers_parameter("float", "", {0.2}, p.where()));
  if (alpha.type == "texture") {
    warn_approximated(p, "\"alpha\" is a texture, 0.2 is used");
  }
  // The standard deviation of slopes, then Oren-Nayar's B, then the parameter of Fujii's form with
  // the same B, at which roughness 1 is Oren-Nayar's largest.
  const double sigma = (alpha.type == "texture" ? 0.2 : alpha.numbers[0]) / std::sqrt(2.0);
  const double b = 0.45 * sigma * sigma / (sigma * sigma + 0.09);
  constexpr double kFujii = 0.5 - 2.0 / (3.0 * kPiDouble);
  add_float(m.parameters, "base_diffuse_roughness", std::min(1.0, b / (1 - kFujii * b)));
  return surface_of(p, std::move(m), true);
}

Surface write_diffuse_transmission(PluginProperties& p) {
  MaterialDescription m = material(p, "diffusetransmission");
  add_color(m.parameters, "transmittance", read_color(p, "transmittance", ColorUse::kReflectance),
            0.5);
  add_rgb(m.parameters, "reflectance", Vec3d(0.0));
  return surface_of(p, std::move(m), false);
}

Surface write_null(PluginProperties& p) {
  return surface_of(p, material(p, "interface"), false);
}

Surface write_measured(PluginProperties& p) {
  MaterialDescription m = material(p, "measured");
  add_text(m.parameters, "filename", p.file());
  return surface_of(p, std::move(m), true);
}

Surface write_hair(PluginProperties& p) {
  MaterialDescription m = material(p, "hair");
  if (const auto absorption = read_color(p, "sigma_a", ColorUse::kUnbounded)) {
    add_as(m.parameters, "sigma_a", absorption->parameter);
  } else {
    add_float(m.parameters, "eumelanin", p.number("eumelanin", 1.3));
    add_float(m.parameters, "pheomelanin", p.number("pheomelanin", 0.2));
  }
  if (p.number("scale", 1) != 1) warn_approximated(p, "\"scale\" is ignored");
  add_float(m.parameters, "beta_m", p.number("longitudinal_roughness", 0.3));
  add_float(m.parameters, "beta_n", p.number("azimuthal_roughness", 0.3));
  add_float(m.parameters, "alpha", p.number("scale_tilt", 2));
  add_float(m.parameters, "eta", relative_index(p, "amber"));
  return surface_of(p, std::move(m), false);
}

}  // namespace nephroid::mitsuba
