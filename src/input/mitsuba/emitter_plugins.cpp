#include "input/mitsuba/emitter_plugins.h"

#include <iterator>
#include <utility>

#include "input/mitsuba/color_value.h"
#include "input/mitsuba/medium_plugins.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/sky_emitters.h"
#include "input/mitsuba/texture_plugins.h"

namespace nephroid::mitsuba {
namespace {

void add_point(ParameterSet& set, const char* name, const Vec3d& point) {
  add_numbers(set, "point3", name, {point.x, point.y, point.z});
}

void write_point(PluginProperties& p, LightDescription& light) {
  light.type = "point";
  add_emission(light.parameters, "I", read_color(p, "intensity", ColorUse::kEmission));
  light.transform = p.transform();
  if (const auto position = p.point("position")) add_point(light.parameters, "from", *position);
}

/// Shines along local +z, as pbrt-v4's. Mitsuba's edge is linear in the angle.
void write_spot(PluginProperties& p, LightDescription& light) {
  light.type = "spot";
  add_emission(light.parameters, "I", read_color(p, "intensity", ColorUse::kEmission));
  light.transform = p.transform();
  const double cutoff = p.number("cutoff_angle", 20);
  const double beam = p.number("beam_width", 0.75 * cutoff);
  if (!(cutoff > 0 && cutoff <= 180 && beam >= 0 && beam <= cutoff))
    throw SceneError(p.where(),
                     "\"cutoff_angle\" and \"beam_width\" are out of range, expected "
                     "0 to 180 degrees, \"beam_width\" not above \"cutoff_angle\"");
  add_float(light.parameters, "coneangle", cutoff);
  add_float(light.parameters, "conedeltaangle", cutoff - beam);
  if (read_color(p, "texture", ColorUse::kUnbounded))
    warn_approximated(p, "\"texture\" is ignored");
}

/// Light travels along local +z, as in pbrt-v4.
void write_directional(PluginProperties& p, LightDescription& light) {
  light.type = "distant";
  add_emission(light.parameters, "L", read_color(p, "irradiance", ColorUse::kEmission));
  light.transform = p.transform();
  const auto direction = p.point("direction");
  if (!direction) return;
  if (!(direction->length() > 0))
    throw SceneError(p.where(), "\"direction\" is the zero vector, expected a direction");
  light.transform = {};
  add_point(light.parameters, "from", Vec3d(0.0));
  add_point(light.parameters, "to", *direction);
}

void write_constant(PluginProperties& p, LightDescription& light) {
  light.type = "infinite";
  add_emission(light.parameters, "L", read_color(p, "radiance", ColorUse::kEmission));
}

void write_environment(PluginProperties& p, LightDescription& light) {
  light.type = "infinite";
  add_text(light.parameters, "filename", p.file());
  const double scale = p.number("scale", 1);
  if (!(scale >= 0)) throw SceneError(p.where(), "\"scale\" is negative, expected 0 or more");
  if (scale != 1) add_float(light.parameters, "scale", scale);
  if (p.number("gamma", 0) > 0) warn_approximated(p, "\"gamma\" is ignored");
  const TransformDescription world = p.transform();
  const Mat44d frame = environment_frame();
  light.transform = {frame * world.start, frame * world.end};
}

void add_name(const std::string& name, ParameterSet& light) {
  if (!name.empty()) add_text(light, "name", name);
}

struct EmitterRow : Plugin {
  void (*write)(PluginProperties& properties, LightDescription& light) = nullptr;
};
using enum PluginSupport;
constexpr EmitterRow kEmitters[] = {
    {{"emitter", "area", kLoaded, "on shapes; a bitmap as radiance is mapped by uv"}},
    {{"emitter", "point"}, write_point},
    {{"emitter", "spot", kLoaded, "the edge is smooth, not linear; a texture is ignored"},
     write_spot},
    {{"emitter", "directional"}, write_directional},
    {{"emitter", "constant"}, write_constant},
    {{"emitter", "envmap", kLoaded,
      "not interpolated between pixels; the image must be twice as wide as high"},
     write_environment},
    {{"emitter", "sky", kApproximated, kSkyNote}, write_sky},
    {{"emitter", "sun", kApproximated, kSkyNote}, write_sun},
    {{"emitter", "sunsky", kApproximated, kSkyNote}, write_sun_and_sky},
    {{"emitter", "collimated", kRefused, "its beam has no width, so no path can meet it"}},
    {{"emitter", "projector", kRefused, "this renderer has no such light"}},
    {{"emitter", "directionalarea", kRefused,
      "its light has one direction, so no path can meet it"}},
    {{"emitter", "timed_sunsky", kRefused, "this renderer has no such light"}},
};

}  // namespace

void write_emitter(ImportContext& context, const Object& object) {
  PluginProperties p(object, context);
  const EmitterRow& row = plugin_row(kEmitters, object, context.diagnostics);
  if (!row.write)
    throw SceneError(object.where, "emitter \"" + object.type +
                                       "\" stands outside of a shape, "
                                       "expected it in one");
  LightDescription light = directive<LightDescription>("", object.where);
  row.write(p, light);
  if (const Object* medium = p.first_child("medium")) light.medium = write_medium(context, *medium);
  if (light.parameters.peek("name") == nullptr) add_name(object.id, light.parameters);
  p.report_unused();
  context.scene.lights.push_back(std::move(light));
}

DirectiveDescription area_light(ImportContext& context, const Object& object,
                                const std::string& name_of_shape) {
  plugin_row(kEmitters, object, context.diagnostics);
  if (object.type != "area")
    throw SceneError(object.where,
                     "emitter \"" + object.type + "\" stands in a shape, expected \"area\"");
  PluginProperties p(object, context);
  DirectiveDescription light = directive("diffuse", object.where);
  if (const Object* texture = p.child("texture", "radiance"))
    add_text(light.parameters, "filename", bitmap_file(context, *texture));
  else
    add_emission(light.parameters, "L", read_color(p, "radiance", ColorUse::kEmission));
  add_name(object.id.empty() ? name_of_shape : object.id, light.parameters);
  p.report_unused();
  return light;
}

std::vector<Plugin> emitter_plugins() {
  return std::vector<Plugin>(std::begin(kEmitters), std::end(kEmitters));
}

}  // namespace nephroid::mitsuba
