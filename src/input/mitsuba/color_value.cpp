#include "input/mitsuba/color_value.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/counted.h"
#include "input/file_bytes.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/spectrum_text.h"
#include "input/mitsuba/texture_plugins.h"
#include "input/mitsuba/value_text.h"

namespace nephroid::mitsuba {
namespace {

ColorValue spectrum_of_pairs(std::vector<double> pairs, ColorUse use, const SourceLocation& where) {
  ColorValue color;
  if (use == ColorUse::kEmission) color.scale = std::max(0.0, luminance_of_pairs(pairs));
  color.parameter = numbers_parameter("spectrum", "", std::move(pairs), where);
  return color;
}

/// The same value at all wavelengths. Mitsuba 3 emits it as equal energy, Mitsuba 0.6 as white.
ColorValue uniform_spectrum(double value, ColorUse use, bool is_before_version_2,
                            const SourceLocation& where) {
  if (use != ColorUse::kEmission || is_before_version_2) return constant_color(Vec3d(value), where);
  return spectrum_of_pairs({360, value, 830, value}, use, where);
}

ColorValue black_body(const Property& p) {
  const double kelvin = kelvin_of_text(
      p.attribute("temperature").empty() ? p.attribute("value") : p.attribute("temperature"),
      p.where);
  ColorValue color;
  color.parameter = numbers_parameter("blackbody", "", {kelvin}, p.where);
  color.scale = luminance_of_black_body(kelvin);
  if (p.attributes.contains("scale"))
    color.scale *= finite_number(p.attribute("scale"), "\"scale\"", p.where);
  return color;
}

ColorValue spectrum_of_file(PluginProperties& properties, const std::string& name, ColorUse use,
                            const SourceLocation& where) {
  SceneFiles& files = *properties.context().scene.files;
  const std::string file = properties.context().file_names.find(files, name, where);
  try {
    return spectrum_of_pairs(pairs_of_file(files.read(files.path_of(file)), where), use, where);
  } catch (const IoError& error) {
    file_is_unreadable(where, error.what());
  }
}

ColorValue color_of_property(PluginProperties& properties, const Property& p, ColorUse use) {
  const bool old = properties.context().is_before_version_2();
  if (p.tag == "rgb" || p.tag == "srgb" || p.tag == "color")
    return constant_color(rgb_of_text(p, p.tag == "srgb"), p.where);
  if (p.tag == "float" || p.tag == "integer")
    return constant_color(
        Vec3d(finite_number(p.attribute("value"), "property \"" + p.name + "\"", p.where)),
        p.where);
  if (p.tag == "blackbody") return black_body(p);
  if (p.tag != "spectrum")
    throw SceneError(p.where, "property \"" + p.name + "\" is a <" + p.tag +
                                  ">, expected a colour or a spectrum");
  if (p.attributes.contains("filename"))
    return spectrum_of_file(properties, p.attribute("filename"), use, p.where);
  const std::string text = p.attribute("value");
  if (text.find(':') != std::string::npos)
    return spectrum_of_pairs(pairs_of_text(text, p.where), use, p.where);
  const std::vector<double> numbers = finite_numbers(text, "property \"" + p.name + "\"", p.where);
  // Mitsuba compiled for rgb takes three numbers, too.
  if (numbers.size() == 3)
    return constant_color(Vec3d(numbers[0], numbers[1], numbers[2]), p.where);
  if (numbers.size() != 1)
    throw SceneError(p.where, "property \"" + p.name + "\" has " + std::to_string(numbers.size()) +
                                  " numbers, expected one, or pairs WAVELENGTH:VALUE");
  return uniform_spectrum(numbers[0], use, old, p.where);
}

// Spectra that Mitsuba 3 writes as plug-ins: <spectrum type="d65"> ...

using SpectrumReader = ColorValue (*)(PluginProperties& properties, ColorUse use);

ColorValue read_uniform(PluginProperties& p, ColorUse use) {
  for (const char* name : {"wavelength_min", "wavelength_max"}) p.find(name);
  return uniform_spectrum(p.number("value", 1), use, false, p.where());
}

ColorValue read_white(PluginProperties& p, ColorUse use) {
  ColorValue color = read_color(p, "color", use).value_or(constant_color(Vec3d(1.0), p.where()));
  const double scale = p.number("scale", 1);
  if (color.rgb) {
    const Vec3d rgb = *color.rgb * scale;
    return constant_color(rgb, p.where());
  }
  color.scale *= scale;
  return color;
}

ColorValue read_regular(PluginProperties& p, ColorUse use) {
  const std::vector<double> values = finite_numbers(p.text("values", ""), "\"values\"", p.where());
  const double first = p.number("wavelength_min", 360), last = p.number("wavelength_max", 830);
  if (values.size() < 2 || !(last > first))
    throw SceneError(p.where(),
                     "a regular spectrum lacks values or wavelengths, expected two \"values\" "
                     "or more, and \"wavelength_max\" above \"wavelength_min\"");
  std::vector<double> pairs;
  for (size_t i = 0; i < values.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(values.size() - 1);
    pairs.push_back(first + (last - first) * share);
    pairs.push_back(values[i]);
  }
  return spectrum_of_pairs(std::move(pairs), use, p.where());
}

ColorValue read_irregular(PluginProperties& p, ColorUse use) {
  const std::vector<double> wavelengths =
      finite_numbers(p.text("wavelengths", ""), "\"wavelengths\"", p.where());
  const std::vector<double> values = finite_numbers(p.text("values", ""), "\"values\"", p.where());
  if (values.size() != wavelengths.size())
    throw SceneError(p.where(), "a spectrum has " + counted(wavelengths.size(), "wavelength") +
                                    " and " + counted(values.size(), "value") +
                                    ", expected equally many");
  std::string text;
  for (size_t i = 0; i < values.size(); ++i)
    text += std::to_string(wavelengths[i]) + ":" + std::to_string(values[i]) + " ";
  std::vector<double> pairs = pairs_of_text(text, p.where());
  for (size_t i = 0; i < values.size(); ++i) {
    pairs[2 * i] = wavelengths[i];
    pairs[2 * i + 1] = values[i];
  }
  return spectrum_of_pairs(std::move(pairs), use, p.where());
}

ColorValue read_black_body(PluginProperties& p, ColorUse) {
  const double kelvin = p.number("temperature", 0);
  if (!(kelvin > 0))
    throw SceneError(p.where(), "the temperature is not above 0 K, expected kelvin");
  ColorValue color;
  color.parameter = numbers_parameter("blackbody", "", {kelvin}, p.where());
  color.scale = luminance_of_black_body(kelvin) * p.number("scale", 1);
  return color;
}

struct SpectrumRow : Plugin {
  SpectrumReader read = nullptr;
};
using enum PluginSupport;
constexpr SpectrumRow kSpectra[] = {
    {{"spectrum", "uniform", kLoaded, "emission has equal energy at all wavelengths"},
     read_uniform},
    {{"spectrum", "d65", kLoaded, "white"}, read_white},
    {{"spectrum", "srgb", kLoaded, "linear rgb with the primaries of sRGB"}, read_white},
    {{"spectrum", "regular"}, read_regular},
    {{"spectrum", "irregular"}, read_irregular},
    {{"spectrum", "blackbody"}, read_black_body},
    {{"spectrum", "rawconstant", kLoaded, "as uniform"}, read_uniform},
};

ColorValue color_of_plugin(ImportContext& context, const Object& object, ColorUse use) {
  PluginProperties properties(object, context);
  const ColorValue color = plugin_row(kSpectra, object, context.diagnostics).read(properties, use);
  properties.report_unused();
  return color;
}

/// Reflectances above 1 and negative colours.
void check_range(ColorValue& color, ColorUse use, Diagnostics& diagnostics) {
  if (!color.rgb) return;
  const Vec3d& c = *color.rgb;
  const SourceLocation where = color.parameter.where;
  if (std::min({c.x, c.y, c.z}) < 0)
    throw SceneError(where, "a colour has a negative component, expected 0 or more");
  if (use != ColorUse::kReflectance || std::max({c.x, c.y, c.z}) <= 1) return;
  diagnostics.warn(where, "a reflectance is above 1, it is rendered as 1");
  color = constant_color(Vec3d(std::min(c.x, 1.0), std::min(c.y, 1.0), std::min(c.z, 1.0)), where);
}

}  // namespace

ColorValue constant_color(const Vec3d& rgb, const SourceLocation& where) {
  ColorValue color;
  color.parameter = numbers_parameter("rgb", "", {rgb.x, rgb.y, rgb.z}, where);
  color.rgb = rgb;
  return color;
}

std::optional<ColorValue> read_color(PluginProperties& properties, const std::string& name,
                                     ColorUse use) {
  ImportContext& context = properties.context();
  std::optional<ColorValue> color;
  if (const Property* p = properties.find(name)) {
    color = color_of_property(properties, *p, use);
  } else if (const Object* spectrum = properties.child("spectrum", name)) {
    color = color_of_plugin(context, *spectrum, use);
  } else if (const Object* texture = properties.child("texture", name)) {
    color.emplace().parameter = text_parameter(
        "texture", "", {write_texture(context, *texture, TextureUse::kColor)}, texture->where);
  }
  if (color) check_range(*color, use, context.diagnostics);
  return color;
}

std::optional<Vec3d> read_rgb(PluginProperties& properties, const std::string& name) {
  const std::optional<ColorValue> color = read_color(properties, name, ColorUse::kUnbounded);
  if (!color) return std::nullopt;
  if (!color->rgb)
    throw SceneError(color->parameter.where,
                     "\"" + name + "\" is a spectrum or a texture, expected an rgb colour");
  return color->rgb;
}

std::optional<Parameter> read_float(PluginProperties& properties, const std::string& name) {
  ImportContext& context = properties.context();
  if (const Object* texture = properties.child("texture", name))
    return text_parameter("texture", "", {write_texture(context, *texture, TextureUse::kNumber)},
                          texture->where);
  const Property* p = properties.find(name);
  if (!p) {
    if (const Object* spectrum = properties.child("spectrum", name)) {
      const ColorValue color = color_of_plugin(context, *spectrum, ColorUse::kUnbounded);
      if (color.rgb) return numbers_parameter("float", "", {mean(*color.rgb)}, spectrum->where);
      throw SceneError(spectrum->where, "\"" + name + "\" is a spectrum, expected a number");
    }
    return std::nullopt;
  }
  const ColorValue color = color_of_property(properties, *p, ColorUse::kUnbounded);
  if (!color.rgb) throw SceneError(p->where, "\"" + name + "\" is a spectrum, expected a number");
  return numbers_parameter("float", "", {mean(*color.rgb)}, p->where);
}

void add_color(ParameterSet& set, const std::string& target, const std::optional<ColorValue>& color,
               double fallback) {
  if (color)
    add_as(set, target, color->parameter);
  else
    add_rgb(set, target, Vec3d(fallback));
}

void add_emission(ParameterSet& set, const std::string& target,
                  const std::optional<ColorValue>& color, double factor) {
  add_color(set, target, color, 1);
  const double scale = factor * (color ? color->scale : 1);
  if (!(scale >= 0) || scale > 1e30)
    throw SceneError(color ? color->parameter.where : set.where,
                     "an emission is negative or too bright, expected 0 to 1e30");
  if (scale != 1) add_float(set, "scale", scale);
}

std::vector<Plugin> spectrum_plugins() {
  return std::vector<Plugin>(std::begin(kSpectra), std::end(kSpectra));
}

}  // namespace nephroid::mitsuba
