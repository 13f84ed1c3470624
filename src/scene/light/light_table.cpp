// Light types by name, see light_table.h.
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

constexpr FormatParameter kCommon[] = {
    {"float", "scale", "1", "", "of the emission; not negative"},
    {"string", "name", "none", "", "what light path expressions call it; not in pbrt-v4"},
};
constexpr FormatParameter kPower[] = {
    {"float", "power", "none", "W",
     "flux of a white lamp if above 0; \"scale\" and the size of an rgb colour still multiply it"}};
constexpr FormatParameter kIlluminance[] = {
    {"float", "illuminance", "none", "lx",
     "of white light on a surface that faces it, if above 0; \"scale\" and the size of an rgb "
     "colour still multiply it, and an image gives twice as much, as in pbrt-v4"}};
constexpr FormatParameter kFrom[] = {{"point3", "from", "0 0 0"}};
constexpr FormatParameter kTo[] = {{"point3", "to", "0 0 1"}};
constexpr FormatParameter kIntensity[] = {
    {"spectrum", "I", "illuminant of the colour space", "intensity"}};
constexpr FormatParameter kDistant[] = {
    {"spectrum", "L", "illuminant of the colour space", "irradiance"},
    {"float", "angle", "0", "degrees",
     "angular diameter, 0 to 180; the irradiance does not depend on it; not in pbrt-v4"}};
constexpr FormatParameter kSpotAxis[] = {
    {"point3", "to", "0 0 1"},
    {"float", "coneangle", "30", "degrees", "0 to 180"},
    {"float", "conedeltaangle", "5", "degrees", "of the edge, inside of the cone"},
};
constexpr FormatParameter kInfinite[] = {
    {"spectrum", "L", "illuminant of the colour space", "radiance",
     "with \"filename\" an error, with \"filename\" and \"portal\" ignored with a warning; with "
     "\"portal\" alone what is not rgb is converted to rgb with a warning"},
    {"string", "filename", "none", "",
     "an equal-area octahedral map (square), or, not in pbrt-v4, a latitude-longitude map (twice "
     "as "
     "wide as high, +z at the top, phi from +x at the left)"},
    {"string[6]", "faces", "none", "",
     "images of a cube in the order +x -x +y -y +z -z, each as OpenGL takes it with its first row "
     "on top; an alpha is a divisor of the colour (RGBD); not together with \"filename\" or "
     "\"portal\"; not in pbrt-v4"},
    {"point3[4]", "portal", "none", "scene units",
     "a rectangle in world space, anything else is an error"},
};
constexpr FormatParameter kProjection[] = {
    {"string", "filename", "none: an error", "", "the image projected"},
    {"float", "fov", "90", "degrees", "of the shorter side, between 0 and 180"},
};
constexpr FormatParameter kGoniometric[] = {
    {"string", "filename", "none", "",
     "a square equal-area octahedral map; without one a warning, and all directions are alike"},
};
constexpr FormatParameter kArea[] = {
    {"spectrum", "L", "illuminant of sRGB", "radiance", "together with \"filename\" an error"},
    {"string", "filename", "none", "", "an image over the shape's uv"},
    {"bool", "twosided", "false"},
};
constexpr FormatParameter kAreaImage[] = {
    {"rgb", "factor", "1 1 1", "", "of the image; not in pbrt-v4"},
    {"string", "uwrap", "clamp", "", "as of textures; not in pbrt-v4"},
    {"string", "vwrap", "clamp", "", "as of textures; not in pbrt-v4"},
    {"float[6]", "uvtransform", "1 0 0 0 1 0", "", "as of textures; not in pbrt-v4"},
};

struct Row : FormatType {
  LightMaker make;
};
constexpr Row kLights[] = {
    {{"point", {kIntensity, kCommon, kPower, kFrom}}, make_point_light},
    {{"spot", {kIntensity, kCommon, kPower, kFrom, kSpotAxis}}, make_spot_light},
    {{"distant", {kDistant, kCommon, kIlluminance, kFrom, kTo}}, make_distant_light},
    {{"infinite", {kInfinite, kCommon, kIlluminance}}, make_infinite_light},
    {{"projection", {kProjection, kCommon, kPower}}, make_projection_light},
    {{"goniometric", {kIntensity, kGoniometric, kCommon, kPower}}, make_goniometric_light},
};
constexpr FormatType kAreaLights[] = {
    {"diffuse",
     {kArea, kAreaImage, kCommon, kPower},
     "\"power\" counts for each triangle, patch or quadric of the shape, with a warning if there "
     "are several; alpha of the shape counts once, as where a camera ray hits. On curves an error, "
     "on interface materials and in object definitions ignored with a warning"}};

}  // namespace

std::vector<FormatType> light_types() {
  return format_types(kLights);
}

std::vector<FormatType> area_light_types() {
  return format_types(kAreaLights);
}

const FormatType& area_light_type(const DirectiveDescription& description) {
  return row_of(kAreaLights, "area light", description.type, description.where);
}

std::vector<LightPtr> make_lights(const SceneDescription& description, Diagnostics& diagnostics) {
  const LightScope scope{*description.files, description.color_space, diagnostics};
  std::vector<LightPtr> lights;
  for (const LightDescription& d : description.lights) {
    const Row& row = row_of(kLights, "light", d.type, d.where);
    if (!is_invertible(d.transform.start))
      throw SceneError(d.where, "the transform of this light has no inverse");
    if (d.transform.is_animated())
      diagnostics.warn(d.where, "a light source cannot move, the start of its motion is used");
    lights.push_back(row.make(d, scope));
    light_name(d.parameters);  // throws if "name" is no string; scene_labels.h uses it
    const auto bounds = lights.back()->bounds();
    if (bounds && !(is_in_reach(bounds->bounds.min) && is_in_reach(bounds->bounds.max)))
      throw SceneError(d.where,
                       "light \"" + d.type + "\" is too far away, expected coordinates up to 1e17");
    // Powers overflow, for example, when "power" is divided by that of an almost black image. The
    // power of infinite lights grows with the scene.
    constexpr float kMaxPower = 1e30f;
    if (!(lights.back()->power() <= kMaxPower))
      throw SceneError(d.where, "light \"" + d.type +
                                    "\" is too bright for floating-point numbers, expected a power "
                                    "up to 1e30");
    warn_of_unused_flux(d.parameters, diagnostics);
    d.parameters.report_unused("light \"" + d.type + "\"", row, diagnostics);
  }
  return lights;
}

}  // namespace nephroid
