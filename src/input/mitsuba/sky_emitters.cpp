#include "input/mitsuba/sky_emitters.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "input/mitsuba/color_value.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/sun_position.h"
#include "input/sky/hosek_wilkie_sky.h"
#include "input/sky/pfm_image.h"
#include "input/sky/preetham_sun.h"

namespace nephroid::mitsuba {
namespace {

constexpr double kSunDiameter = 0.5358 * kPiDouble / 180;
constexpr int kWidth = 512, kHeight = 256;  ///< pixels of the sky's image, as in Mitsuba

/// The direction in Mitsuba's frame of environment maps.
Vec3d direction_of(double zenith, double azimuth) {
  return {std::sin(azimuth) * std::sin(zenith), std::cos(zenith),
          -std::cos(azimuth) * std::sin(zenith)};
}

/// Mitsuba 3 has +z up in skies: local frame with +y up to that one.
Mat44d up_axis(const ImportContext& context) {
  Mat44d m;
  if (context.version < 3) return m;
  m[1][1] = m[2][2] = 0;
  m[1][2] = 1;
  m[2][1] = -1;
  return m;
}

/// What sun and sky have in common.
struct Daylight {
  Mat44d to_world;
  SunPosition sun;
  double turbidity = 3, stretch = 1;
};

SunPosition position_of(const Vec3d& direction) {
  const Vec3d d = direction.normalized();
  const double azimuth = std::atan2(d.x, -d.z);
  return {std::acos(std::clamp(d.y, -1.0, 1.0)), azimuth < 0 ? azimuth + 2 * kPiDouble : azimuth};
}

PlaceAndTime place_and_time(PluginProperties& p) {
  PlaceAndTime t;
  t.latitude = p.number("latitude", t.latitude);
  t.longitude = p.number("longitude", t.longitude);
  t.time_zone = p.number("timezone", t.time_zone);
  t.year = p.integer("year", t.year);
  t.month = p.integer("month", t.month);
  t.day = p.integer("day", t.day);
  t.hour = p.number("hour", t.hour);
  t.minute = p.number("minute", t.minute);
  t.second = p.number("second", t.second);
  if (std::abs(t.year) > 10000 || t.month < 1 || t.month > 12 || t.day < 1 || t.day > 31)
    throw SceneError(p.where(), "the date is wrong, expected year, month (1 to 12) and day");
  return t;
}

Daylight read_daylight(PluginProperties& p) {
  Daylight d;
  d.to_world = up_axis(p.context()) * p.transform().start;
  d.turbidity = p.number("turbidity", 3);
  d.stretch = p.number("stretch", 1);
  if (!(d.turbidity >= 1 && d.turbidity <= 10))
    throw SceneError(p.where(), "\"turbidity\" is out of range, expected 1 to 10");
  if (!(d.stretch >= 1 && d.stretch <= 2))
    throw SceneError(p.where(), "\"stretch\" is out of range, expected 1 to 2");
  if (const auto world = p.point("sun_direction")) {
    Vec3d local;
    d.to_world.inverse().multDirMatrix(*world, local);
    if (!(local.length() > 0))
      throw SceneError(p.where(), "\"sun_direction\" is the zero vector, expected a direction");
    d.sun = position_of(local);
  } else {
    d.sun = sun_position(place_and_time(p));
  }
  if (!(d.sun.zenith < 0.5 * kPiDouble))
    throw SceneError(p.where(), "the sun is below the horizon, expected it above");
  p.integer("resolution", 0);
  return d;
}

double factor(PluginProperties& p, const char* name, double fallback) {
  const double value = p.number(name, fallback);
  if (!(value >= 0))
    throw SceneError(p.where(), std::string("\"") + name + "\" is negative, expected 0 or more");
  return value;
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Latitude-longitude image of the sky, rows from the zenith.
std::vector<Rgb> sky_pixels(const Daylight& d, const Vec3d& albedo, bool extends) {
  const HosekWilkieSky sky(d.turbidity, albedo, 0.5 * kPiDouble - d.sun.zenith);
  std::vector<Rgb> pixels;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double zenith = (y + 0.5) * kPiDouble / kHeight;
      const double azimuth = (x + 0.5) * 2 * kPiDouble / kWidth;
      double theta = zenith / d.stretch;
      const bool is_below = theta >= 0.5 * kPiDouble;
      if (is_below) theta = 0.5 * kPiDouble - 1e-4;
      const double cos_gamma =
          std::cos(theta) * std::cos(d.sun.zenith) +
          std::sin(theta) * std::sin(d.sun.zenith) * std::cos(azimuth - d.sun.azimuth);
      double share = is_below && !extends ? 0 : 1;
      if (extends) share = smooth_step(2 - 2 * zenith / kPiDouble);
      pixels.push_back(sky.radiance(theta, std::acos(std::clamp(cos_gamma, -1.0, 1.0))) *
                       static_cast<float>(share));
    }
  return pixels;
}

/// The name of sun or sky as a lamp: the emitter's id, where that is not both.
std::string name_of(PluginProperties& p, const std::string& part) {
  const std::string& id = p.object().id;
  if (id.empty()) return part;
  return p.object().type == "sunsky" ? id + "-" + part : id;
}

void set_sky(PluginProperties& p, const Daylight& d, double scale, double default_albedo,
             LightDescription& light) {
  const Vec3d albedo = read_rgb(p, "albedo").value_or(Vec3d(default_albedo));
  for (int i = 0; i < 3; ++i)
    if (!(albedo[i] >= 0 && albedo[i] <= 1))
      throw SceneError(p.where(), "\"albedo\" is out of range, expected 0 to 1");
  const std::string name = p.context().unique_name(p.object()) + "#/sky.pfm";
  p.context().scene.files->add_in_memory(
      name, pfm_image(sky_pixels(d, albedo, p.boolean("extend", false)), kWidth, kHeight));
  light.type = "infinite";
  add_text(light.parameters, "name", name_of(p, "sky"));
  add_text(light.parameters, "filename", name);
  if (scale != 1) add_float(light.parameters, "scale", scale);
  const Mat44d to_world = environment_frame() * d.to_world;
  light.transform = {to_world, to_world};
}

void set_sun(PluginProperties& p, const Daylight& d, double scale, LightDescription& light) {
  const double solid_angle = 2 * kPiDouble * (1 - std::cos(0.5 * kSunDiameter));
  const Rgb irradiance =
      sun_radiance(d.sun.zenith, d.turbidity) * static_cast<float>(scale * solid_angle);
  light.type = "distant";
  add_text(light.parameters, "name", name_of(p, "sun"));
  add_rgb(light.parameters, "L", {irradiance.r, irradiance.g, irradiance.b});
  const Vec3d to_sun = direction_of(d.sun.zenith * d.stretch, d.sun.azimuth);
  add_numbers(light.parameters, "point3", "from", {to_sun.x, to_sun.y, to_sun.z});
  add_numbers(light.parameters, "point3", "to", {0, 0, 0});
  const double size = factor(p, "sun_radius_scale", 1);
  if (size > 0)
    add_float(light.parameters, "angle", std::min(180.0, size * kSunDiameter * 180 / kPiDouble));
  light.transform = {d.to_world, d.to_world};
}

}  // namespace

Mat44d environment_frame() {
  Mat44d m;
  const double rows[3][3] = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = rows[i][j];
  return m;
}

void write_sky(PluginProperties& p, LightDescription& light) {
  set_sky(p, read_daylight(p), factor(p, "scale", 1), 0.2, light);
}

void write_sun(PluginProperties& p, LightDescription& light) {
  set_sun(p, read_daylight(p), factor(p, "scale", 1), light);
}

void write_sun_and_sky(PluginProperties& p, LightDescription& light) {
  const Daylight daylight = read_daylight(p);
  const double scale = factor(p, "scale", 1);
  LightDescription sun = directive<LightDescription>("", p.where());
  set_sun(p, daylight, factor(p, "sun_scale", scale), sun);
  p.context().scene.lights.push_back(std::move(sun));
  set_sky(p, daylight, factor(p, "sky_scale", scale), p.context().version < 3 ? 0.2 : 0.3, light);
}

}  // namespace nephroid::mitsuba
