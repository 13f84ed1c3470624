#include "input/mitsuba/volume_source.h"

#include <iterator>

#include "input/file_bytes.h"
#include "input/mitsuba/color_value.h"

namespace nephroid::mitsuba {
namespace {

constexpr const char* kNoSuchVolume = "this renderer has no such volume";
constexpr Plugin kVolumes[] = {
    {"volume", "constvolume"},
    {"volume", "gridvolume"},
    {"volume", "hgridvolume", PluginSupport::kRefused, kNoSuchVolume},
    {"volume", "volcache", PluginSupport::kRefused, kNoSuchVolume},
};

/// Mitsuba 0.6 and 2 have values at the corners of the box: cells around them reach half a cell
/// beyond. Mitsuba 3 has them in the middle of cells.
void widen(VolumeSource& source) {
  for (int i = 0; i < 3; ++i) {
    if (source.grid.resolution[i] < 2) continue;
    const double half = 0.5 * (source.p1[i] - source.p0[i]) / (source.grid.resolution[i] - 1);
    source.p0[i] -= half;
    source.p1[i] += half;
  }
}

void set_box(PluginProperties& p, VolumeSource& source) {
  const bool old = p.context().is_before_version_2();
  const bool of_file = old || p.boolean("use_grid_bbox", false);
  source.p0 = of_file ? to_double(source.grid.min) : Vec3d(0.0);
  source.p1 = of_file ? to_double(source.grid.max) : Vec3d(1.0);
  const auto min = p.point("min"), max = p.point("max");
  if (old && min && max) {
    source.p0 = *min;
    source.p1 = *max;
  }
  for (int i = 0; i < 3; ++i)
    if (!(source.p1[i] > source.p0[i]))
      throw SceneError(p.where(),
                       "the box of the volume is empty, expected a lower and a higher "
                       "corner");
  if (p.context().version < 3) widen(source);
}

}  // namespace

bool is_grid(const Object& object) {
  return object.type == "gridvolume";
}

Vec3d constant_volume(ImportContext& context, const Object& object) {
  plugin_row(kVolumes, object, context.diagnostics);
  if (is_grid(object)) throw SceneError(object.where, "this is a grid, expected a constant volume");
  PluginProperties p(object, context);
  const Vec3d value = read_rgb(p, "value").value_or(Vec3d(1.0));
  p.report_unused();
  return value;
}

VolumeSource read_volume(ImportContext& context, const Object& object) {
  plugin_row(kVolumes, object, context.diagnostics);
  PluginProperties p(object, context);
  const std::string file = p.file();
  VolumeSource source;
  try {
    SceneFiles& files = *context.scene.files;
    source.grid = read_volume_grid(files.read(files.path_of(file)), p.find("filename")->where);
  } catch (const IoError& error) {
    file_is_unreadable(p.find("filename")->where, error.what());
  }
  source.to_world = p.transform().start;
  set_box(p, source);
  if (p.text("filter_type", "trilinear") != "trilinear")
    warn_approximated(p, "the grid is interpolated");
  if (p.text("wrap_mode", "clamp") != "clamp")
    warn_approximated(p, "the medium ends at the walls of the grid");
  p.boolean("raw", false);
  p.number("max_value", 0);
  p.report_unused();
  return source;
}

std::vector<Plugin> volume_plugins() {
  return std::vector<Plugin>(std::begin(kVolumes), std::end(kVolumes));
}

}  // namespace nephroid::mitsuba
