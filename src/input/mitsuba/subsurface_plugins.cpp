#include "input/mitsuba/subsurface_plugins.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "input/mitsuba/bsdf_writers.h"
#include "input/mitsuba/refraction_index.h"
#include "input/mitsuba/scattering_coefficients.h"

namespace nephroid::mitsuba {
namespace {

/// Index of the substances of the presets (Jensen et al. 2001).
constexpr double kPresetIndex = 1.3;

/// Copies the roughness of the boundary.
void add_boundary(ParameterSet& set, const MaterialDescription& boundary) {
  constexpr std::array kNames = {"roughness", "uroughness", "vroughness", "remaproughness"};
  if (boundary.type == "principled") return;
  for (const Parameter& parameter : boundary.parameters.list)
    if (std::find(kNames.begin(), kNames.end(), parameter.name) != kNames.end())
      set.list.push_back(parameter);
}

/// Jensen's dipole as pbrt-v4's table of the same medium, which scatters once, too.
MaterialDescription dipole(PluginProperties& p) {
  MaterialDescription m = material(p, "subsurface");
  const auto coefficients = read_coefficients(p);
  double scale = p.number("scale", 1);
  if (coefficients) {
    add_rgb(m.parameters, "sigma_a", coefficients->absorption);
    add_rgb(m.parameters, "sigma_s", coefficients->scattering);
    add_float(m.parameters, "g", p.number("g", 0));
  } else {
    add_text(m.parameters, "name", preset_name(p));
    scale *= kPresetScale;
  }
  if (scale != 1) add_float(m.parameters, "scale", scale);
  const bool has_index = p.has("int_ior") || p.has("ext_ior");
  add_float(m.parameters, "eta", has_index ? relative_index(p, "bk7") : kPresetIndex);
  for (const char* name : {"irr_samples", "irr_indirect", "sample_multiplier", "quality"})
    p.find(name);
  return m;
}

constexpr Plugin kSubsurface[] = {
    {"subsurface", "dipole", PluginSupport::kApproximated,
     "pbrt-v4's subsurface material of the same medium, below a boundary with the roughness of the "
     "BSDF"},
    {"subsurface", "singlescatter", PluginSupport::kIgnored, "only the BSDF is rendered"},
};

}  // namespace

Surface write_subsurface(ImportContext& context, const Object& object, const Surface& boundary) {
  const std::pair key(&object, boundary.material);
  const auto known = context.subsurfaces.find(key);
  if (known != context.subsurfaces.end()) return known->second;
  Surface surface = boundary;
  if (object.type == "dipole") {
    plugin_row(kSubsurface, object, context.diagnostics);
    PluginProperties p(object, context);
    MaterialDescription m = dipole(p);
    add_boundary(m.parameters, written_material(context, boundary.material));
    p.report_unused();
    surface.material = add_material(p, std::move(m));
  } else {
    // Without its model the scene still makes sense, whatever the plug-in.
    context.diagnostics.warn(
        object.where, "subsurface \"" + object.type + "\" is ignored: only the BSDF is rendered");
  }
  return context.subsurfaces[key] = surface;
}

std::vector<Plugin> subsurface_plugins() {
  return std::vector<Plugin>(std::begin(kSubsurface), std::end(kSubsurface));
}

}  // namespace nephroid::mitsuba
