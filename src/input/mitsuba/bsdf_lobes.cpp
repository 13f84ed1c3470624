// BSDFs of a diffuse and a glossy lobe without Fresnel terms: Phong and Ward.
#include <algorithm>
#include <cmath>

#include "input/mitsuba/bsdf_writers.h"

namespace nephroid::mitsuba {
namespace {

Vec3d color_of(PluginProperties& p, const char* name, double fallback) {
  const auto color = read_color(p, name, ColorUse::kReflectance);
  if (!color) return Vec3d(fallback);
  if (color->rgb) return *color->rgb;
  warn_approximated(p, std::string("\"") + name + "\" is not an rgb colour, its default is used");
  return Vec3d(fallback);
}

Vec3d at_most_one(const Vec3d& v) {
  return {std::min(v.x, 1.0), std::min(v.y, 1.0), std::min(v.z, 1.0)};
}

std::string diffuse_lobe(PluginProperties& p, const Vec3d& reflectance) {
  MaterialDescription m = material(p, "diffuse");
  add_rgb(m.parameters, "reflectance", at_most_one(reflectance));
  return add_material(p, std::move(m));
}

std::string glossy_lobe(PluginProperties& p, const Vec3d& reflectance, const Parameter& alpha_u,
                        const Parameter& alpha_v) {
  MaterialDescription m = material(p, "conductor");
  add_rgb(m.parameters, "reflectance", at_most_one(reflectance));
  add_as(m.parameters, "uroughness", alpha_u);
  add_as(m.parameters, "vroughness", alpha_v);
  add_bool(m.parameters, "remaproughness", false);
  return add_material(p, std::move(m));
}

/// A mixture whose lobes have, weighed by their shares, the reflectances of the BSDF.
Surface lobes(PluginProperties& p, const Parameter& alpha_u, const Parameter& alpha_v) {
  const Vec3d diffuse = color_of(p, "diffuse_reflectance", 0.5);
  const Vec3d glossy = color_of(p, "specular_reflectance", 0.2);
  const double sum = mean(diffuse) + mean(glossy);
  const double share = sum > 0 ? mean(glossy) / sum : 0;
  Surface surface;
  surface.is_one_sided = true;
  if (share <= 0) {
    surface.material = diffuse_lobe(p, diffuse);
  } else if (share >= 1) {
    surface.material = glossy_lobe(p, glossy, alpha_u, alpha_v);
  } else {
    const std::string first = diffuse_lobe(p, diffuse / (1 - share));
    const std::string second = glossy_lobe(p, glossy / share, alpha_u, alpha_v);
    surface.material =
        mixture(p, first, second, numbers_parameter("float", "", {share}, p.where()));
  }
  return surface;
}

}  // namespace

Surface write_phong(PluginProperties& p) {
  const auto exponent = read_float(p, "exponent");
  if (exponent && exponent->type == "texture")
    warn_approximated(p, "\"exponent\" is a texture, 30 is used");
  const double n = exponent && exponent->type == "float" ? exponent->numbers[0] : 30;
  if (!(n >= 0)) throw SceneError(exponent->where, "\"exponent\" is negative, expected 0 or more");
  // The angle to the half vector is half of that to the mirror direction: its exponent is 4 n, and
  // alpha^2 = 2 / (exponent + 2).
  const Parameter alpha = numbers_parameter("float", "", {std::sqrt(2 / (4 * n + 2))}, p.where());
  return lobes(p, alpha, alpha);
}

Surface write_ward(PluginProperties& p) {
  const Parameter alpha = read_alpha(p, "alpha", numbers_parameter("float", "", {0.1}, p.where()));
  p.text("variant", "");
  return lobes(p, read_alpha(p, "alpha_u", alpha), read_alpha(p, "alpha_v", alpha));
}

}  // namespace nephroid::mitsuba
