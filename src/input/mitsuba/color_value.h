// Colours and spectra of Mitsuba as parameters of pbrt-v4. It must not know the plug-ins that use
// them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

/// What a colour is for: pbrt-v4 turns rgb into spectra accordingly.
enum class ColorUse { kReflectance, kUnbounded, kEmission };

struct ColorValue {
  Parameter parameter;       ///< rgb, spectrum, blackbody or texture
  double scale = 1;          ///< of an emission, whose spectrum pbrt-v4 divides by its luminance
  std::optional<Vec3d> rgb;  ///< linear rgb, if the colour is one

  bool is_texture() const { return parameter.type == "texture"; }
};

/// The colour, spectrum or texture of that name; empty if absent. Reflectances above 1 become 1
/// with a warning.
std::optional<ColorValue> read_color(PluginProperties& properties, const std::string& name,
                                     ColorUse use);

/// An rgb or grey colour as a number per channel; empty if absent. Throws SceneError for textures
/// and spectra of wavelengths.
std::optional<Vec3d> read_rgb(PluginProperties& properties, const std::string& name);

/// A number or a texture of numbers; empty if absent.
std::optional<Parameter> read_float(PluginProperties& properties, const std::string& name);

ColorValue constant_color(const Vec3d& rgb, const SourceLocation& where);

/// Mean of the channels; exact for grey.
inline double mean(const Vec3d& rgb) {
  return rgb.x + ((rgb.y - rgb.x) + (rgb.z - rgb.x)) / 3.0;
}

/// Adds a colour as `target`, or the constant `fallback` if there is none.
void add_color(ParameterSet& set, const std::string& target, const std::optional<ColorValue>& color,
               double fallback);

/// Adds an emission as `target`, white by default, with its "scale" times `factor`.
void add_emission(ParameterSet& set, const std::string& target,
                  const std::optional<ColorValue>& color, double factor = 1);

/// Spectra that are plug-ins: <spectrum type="d65"> ...
std::vector<Plugin> spectrum_plugins();

}  // namespace nephroid::mitsuba
