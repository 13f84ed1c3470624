#include "input/mitsuba/medium_plugins.h"

#include <iterator>
#include <utility>

#include "input/mitsuba/color_value.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/scattering_coefficients.h"
#include "input/mitsuba/volume_source.h"

namespace nephroid::mitsuba {
namespace {

using enum PluginSupport;

constexpr const char* kNoSuchPhase = "this renderer has no such phase function";
constexpr Plugin kPhases[] = {
    {"phase", "isotropic"},
    {"phase", "hg"},
    {"phase", "rayleigh", kApproximated, "isotropic"},
    {"phase", "kkay", kRefused, kNoSuchPhase},
    {"phase", "microflake", kRefused, kNoSuchPhase},
    {"phase", "mixturephase", kRefused, kNoSuchPhase},
    {"phase", "blendphase", kRefused, kNoSuchPhase},
    {"phase", "sggx", kRefused, kNoSuchPhase},
    {"phase", "tabphase", kRefused, kNoSuchPhase},
};

/// Mean cosine of the phase function.
double mean_cosine(PluginProperties& medium) {
  const Object* phase = medium.first_child("phase");
  if (!phase) return 0;
  PluginProperties p(*phase, medium.context());
  plugin_row(kPhases, *phase, medium.context().diagnostics);
  const double g = phase->type == "hg" ? p.number("g", 0.8) : 0;
  if (!(g > -1 && g < 1)) throw SceneError(phase->where, "\"g\" is out of range, expected -1 to 1");
  p.report_unused();
  return g;
}

void write_homogeneous(PluginProperties& p, MediumDescription& m) {
  m.type = "homogeneous";
  std::optional<Coefficients> c = read_coefficients(p);
  if (!c && !p.context().is_before_version_2()) c = of_extinction(Vec3d(1.0), read_albedo(p));
  double scale = p.number("scale", 1);
  if (p.has("material") || !c) {
    add_text(m.parameters, "preset", preset_name(p));
    scale *= kPresetScale;
  } else {
    add_rgb(m.parameters, "sigma_a", c->absorption);
    add_rgb(m.parameters, "sigma_s", c->scattering);
  }
  if (scale != 1) add_float(m.parameters, "scale", scale);
}

/// Densities times the albedo at the same voxel, as coefficients in rgb.
void add_colored_grid(PluginProperties& p, MediumDescription& m, const VolumeSource& density,
                      const VolumeSource& albedo) {
  m.type = "rgbgrid";
  std::vector<double> absorption, scattering;
  for (size_t i = 0; i < density.grid.voxels(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double t = density.grid.values[i];
      const double a =
          albedo.grid.values[albedo.grid.channels == 3 ? 3 * i + static_cast<size_t>(c) : i];
      if (a > 1) throw SceneError(p.where(), "an albedo is above 1, expected 0 to 1");
      absorption.push_back(t * (1 - a));
      scattering.push_back(t * a);
    }
  add_numbers(m.parameters, "rgb", "sigma_a", std::move(absorption));
  add_numbers(m.parameters, "rgb", "sigma_s", std::move(scattering));
}

void add_grid(PluginProperties& p, MediumDescription& m, const VolumeSource& density) {
  if (density.grid.channels != 1)
    throw SceneError(p.where(), "the density has colours, expected one channel");
  const Object* albedo_volume = p.child("volume", "albedo");
  if (albedo_volume && is_grid(*albedo_volume)) {
    const VolumeSource albedo = read_volume(p.context(), *albedo_volume);
    if (albedo.grid.voxels() != density.grid.voxels() || albedo.p0 != density.p0 ||
        albedo.p1 != density.p1)
      throw SceneError(albedo_volume->where,
                       "density and albedo have different grids, expected the same one");
    add_colored_grid(p, m, density, albedo);
  } else {
    m.type = "uniformgrid";
    const Vec3d albedo = read_albedo(p);
    add_rgb(m.parameters, "sigma_a", Vec3d(1.0) - albedo);
    add_rgb(m.parameters, "sigma_s", albedo);
    add_numbers(m.parameters, "float", "density",
                std::vector<double>(density.grid.values.begin(), density.grid.values.end()));
  }
  m.transform = {density.to_world, density.to_world};
  const char* const kSizes[] = {"nx", "ny", "nz"};
  for (int i = 0; i < 3; ++i) add_integer(m.parameters, kSizes[i], density.grid.resolution[i]);
  add_numbers(m.parameters, "point3", "p0", {density.p0.x, density.p0.y, density.p0.z});
  add_numbers(m.parameters, "point3", "p1", {density.p1.x, density.p1.y, density.p1.z});
}

void write_heterogeneous(PluginProperties& p, MediumDescription& m) {
  const Object* density = p.child("volume", "density");
  if (!density) density = p.child("volume", "sigma_t");
  if (density && is_grid(*density)) {
    add_grid(p, m, read_volume(p.context(), *density));
  } else {
    m.type = "homogeneous";
    const Vec3d extinction = density ? constant_volume(p.context(), *density)
                                     : read_rgb(p, "sigma_t").value_or(Vec3d(1.0));
    const Coefficients c = of_extinction(extinction, read_albedo(p));
    add_rgb(m.parameters, "sigma_a", c.absorption);
    add_rgb(m.parameters, "sigma_s", c.scattering);
  }
  if (p.child("volume", "orientation")) warn_approximated(p, "\"orientation\" is ignored");
  const double scale = p.number("scale", 1);
  if (scale != 1) add_float(m.parameters, "scale", scale);
}

struct MediumRow : Plugin {
  void (*write)(PluginProperties& properties, MediumDescription& medium) = nullptr;
};
constexpr MediumRow kMedia[] = {
    {{"medium", "homogeneous"}, write_homogeneous},
    {{"medium", "heterogeneous", kLoaded, "density and albedo have the same grid, or are constant"},
     write_heterogeneous},
};

}  // namespace

std::string write_medium(ImportContext& context, const Object& object) {
  const auto known = context.media.find(&object);
  if (known != context.media.end()) return known->second;
  PluginProperties p(object, context);
  MediumDescription medium = directive<MediumDescription>("", object.where);
  plugin_row(kMedia, object, context.diagnostics).write(p, medium);
  if (const double g = mean_cosine(p); g != 0) add_float(medium.parameters, "g", g);
  p.report_unused();
  medium.name = context.unique_name(object);
  context.scene.media.push_back(medium);
  return context.media[&object] = medium.name;
}

std::vector<Plugin> medium_plugins() {
  std::vector<Plugin> all(std::begin(kMedia), std::end(kMedia));
  all.insert(all.end(), std::begin(kPhases), std::end(kPhases));
  const std::vector<Plugin> volumes = volume_plugins();
  all.insert(all.end(), volumes.begin(), volumes.end());
  return all;
}

}  // namespace nephroid::mitsuba
