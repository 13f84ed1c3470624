// Scattering coefficients in Mitsuba's forms, for media and for subsurface scattering. It must not
// know what they are for.
#pragma once

#include <optional>
#include <string>

#include "input/mitsuba/plugin_properties.h"

namespace nephroid::mitsuba {

/// Absorption and scattering, in inverse scene units.
struct Coefficients {
  Vec3d absorption, scattering;
};

Coefficients of_extinction(const Vec3d& extinction, const Vec3d& albedo);

/// "albedo", by default 0.75. Throws SceneError if it is out of range.
Vec3d read_albedo(PluginProperties& properties);

/// "sigma_a" and "sigma_s", or "sigma_t" and "albedo"; empty if none of the sigmas is given.
std::optional<Coefficients> read_coefficients(PluginProperties& properties);

/// The substance in "material", by pbrt-v4's name.
std::string preset_name(PluginProperties& properties);
/// Mitsuba's presets are pbrt-v4's, per millimetre, for scenes in units of ten centimetres.
inline constexpr double kPresetScale = 100;

}  // namespace nephroid::mitsuba
