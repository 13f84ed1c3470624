// Smooth and rough conductors.
#include <algorithm>
#include <cmath>

#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/metals.h"
#include "input/mitsuba/refraction_index.h"

namespace nephroid::mitsuba {
namespace {

/// Divides the index by that of the surrounding substance.
void divide(PluginProperties& p, Parameter& index, double by) {
  if (by == 1) return;
  if (index.type == "rgb") {
    for (double& v : index.numbers) v /= by;
  } else if (index.type == "spectrum" && index.strings.empty()) {
    for (size_t i = 1; i < index.numbers.size(); i += 2) index.numbers[i] /= by;
  } else if (std::abs(by - 1) > 1e-3) {
    warn_approximated(p, "\"ext_eta\" is ignored, as the index is measured or a texture");
  }
}

/// Parameters eta and k.
void add_index(PluginProperties& p, ParameterSet& set, const std::string& metal) {
  const Property* named = p.find("material");
  MetalIndex index = metal_index(metal, named ? named->where : p.where());
  if (const auto eta = read_color(p, "eta", ColorUse::kUnbounded)) index.eta = eta->parameter;
  if (const auto k = read_color(p, "k", ColorUse::kUnbounded)) index.k = k->parameter;
  const double outside = refraction_index(p, "ext_eta", "air");
  divide(p, index.eta, outside);
  divide(p, index.k, outside);
  add_as(set, "eta", index.eta);
  add_as(set, "k", index.k);
}

/// Mitsuba's "none" is a mirror; Mitsuba 3 also has one by default.
bool is_mirror(PluginProperties& p, std::string* metal) {
  const bool has_index =
      p.has("eta") || p.has("k") || p.child("spectrum", "eta") || p.child("texture", "eta");
  *metal = p.text("material", has_index || p.context().is_before_version_2() ? "Cu" : "none");
  const bool is_none = *metal == "none" || *metal == "None";
  if (is_none && has_index) *metal = "Cu";
  return is_none && !has_index;
}

/// A metal that reflects less than by its index absorbs the rest.
std::string dimmed(PluginProperties& p, const std::string& metal,
                   const std::optional<ColorValue>& reflectance) {
  if (!reflectance || (reflectance->rgb && *reflectance->rgb == Vec3d(1.0))) return metal;
  if (!reflectance->rgb) {
    warn_approximated(p, "a texture or spectrum in \"specular_reflectance\" is ignored");
    return metal;
  }
  const Vec3d& rgb = *reflectance->rgb;
  if (rgb.x != rgb.y || rgb.y != rgb.z)
    warn_approximated(p, "a coloured \"specular_reflectance\" is replaced by its mean");
  return mixture(p, metal, black_material(p.context(), p.where()),
                 numbers_parameter("float", "", {1 - mean(rgb)}, p.where()));
}

Surface write_metal(PluginProperties& p, bool is_rough) {
  MaterialDescription m = material(p, "conductor");
  const auto reflectance = read_color(p, "specular_reflectance", ColorUse::kReflectance);
  std::string metal;
  const bool mirror = is_mirror(p, &metal);
  if (mirror)
    add_color(m.parameters, "reflectance", reflectance, 1);
  else
    add_index(p, m.parameters, metal);
  if (is_rough) add_roughness(p, m.parameters);
  Surface surface = surface_of(p, std::move(m), true);
  if (!mirror) surface.material = dimmed(p, surface.material, reflectance);
  return surface;
}

}  // namespace

Surface write_conductor(PluginProperties& p) {
  if (p.has("alpha") && p.number("alpha", 0) > 0)
    warn_approximated(p, "\"alpha\" is ignored, a smooth conductor has none");
  return write_metal(p, false);
}

Surface write_rough_conductor(PluginProperties& p) {
  return write_metal(p, true);
}

}  // namespace nephroid::mitsuba
