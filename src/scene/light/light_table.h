// The table of light types: the scene format's name and its maker. A new light is one file with its
// maker and one row in light_table.cpp. The makers must not know the rest of the scene.
#pragma once

#include "input/format_rows.h"
#include "scene/light/emission_spectrum.h"
#include "scene/light/light.h"
#include "scene/texture/image_file.h"

namespace nephroid {

/// The parts of the scene that a maker needs besides its directive.
struct LightScope {
  SceneFiles& files;
  const std::string& color_space;  ///< colour space of lights that name no colour
  Diagnostics& diagnostics;
};

/// All types of LightSource and of AreaLightSource.
std::vector<FormatType> light_types();
std::vector<FormatType> area_light_types();
/// The row of the directive's area light. Throws SceneError if there is none.
const FormatType& area_light_type(const DirectiveDescription&);

/// The parameter "name", the light's name in light path expressions (scene_labels.h). Empty if
/// there is none. Throws SceneError if it is no string.
inline std::string light_name(const ParameterSet& parameters) {
  return parameters.get_string("name", "");
}

using LightMaker = LightPtr (*)(const LightDescription&, const LightScope&);

// The makers, one per file.
LightPtr make_point_light(const LightDescription&, const LightScope&);
LightPtr make_spot_light(const LightDescription&, const LightScope&);
LightPtr make_distant_light(const LightDescription&, const LightScope&);
/// A distant light of this angular diameter (radians, above 0 and up to pi) around the unit
/// direction `to_light`. `irradiance` scales `spectrum` to that of a surface that faces the light.
LightPtr make_sun_light(const Vec3f& to_light, float angle, const Spectrum& spectrum,
                        float irradiance);
/// Uniform; or one of the two below if there is a "filename" or a "portal".
LightPtr make_infinite_light(const LightDescription&, const LightScope&);
LightPtr make_image_infinite_light(const LightDescription&, const LightScope&);
/// An infinite light with a "portal".
LightPtr make_portal_infinite_light(const LightDescription&, const LightScope&);
LightPtr make_projection_light(const LightDescription&, const LightScope&);
LightPtr make_goniometric_light(const LightDescription&, const LightScope&);

/// The spectrum of a light and its photometric scale.
struct EmissionColor {
  SpectrumPtr spectrum;
  float scale = 1;  ///< "scale" over the spectrum's luminance; the radiance is scale * spectrum
};

/// Reads the parameter `name` as emission, by default the illuminant of the colour space. Throws
/// SceneError for colours and scales that are negative or not finite.
EmissionColor read_emission(const ParameterSet& parameters, const std::string& name,
                            SceneFiles& files, const std::string& color_space);

/// "scale" over the luminance of the illuminant of an image's colour space. Throws SceneError for
/// scales that are negative, not finite or enormous.
float image_emission_scale(const ParameterSet& parameters, const RgbColorSpace& space);

/// `scale` times the factor that brings a light from `unscaled` to the `value` that the parameter
/// `wanted` asks for; 0 if `unscaled` is 0. Throws SceneError if the result overflows.
float scale_to(const Parameter& wanted, float value, double unscaled, float scale);

/// Warns of a "power" or "illuminance" that the light has read but not used, since it is not above
/// 0. -1 stands for none, as in pbrt-v4.
void warn_of_unused_flux(const ParameterSet& parameters, Diagnostics& diagnostics);

/// The image named by "filename". Throws SceneError if it has infinite, NaN or enormous values.
ImagePtr read_light_image(const ParameterSet& parameters, SceneFiles& files);

/// Reads an equal-area octahedral map of the sphere. Throws SceneError if it is not square.
/// `of_what` names the light in the error.
ImagePtr read_sphere_image(const ParameterSet& parameters, SceneFiles& files,
                           const std::string& of_what);

/// Reads the map of an infinite light (sphere_map.h): an image that is square or twice as wide as
/// high, or the "faces" of a cube.
ImagePtr read_environment_image(const ParameterSet& parameters, SceneFiles& files);

/// image_emission_scale for a map of the sphere, times the factor for its "illuminance".
float sphere_emission_scale(const ParameterSet& parameters, const Image& image);

/// Mean of r, g and b; negative values, which cannot be emitted, count as 0.
inline float positive_mean(const Rgb& c) {
  return (std::max(0.0f, c.r) + std::max(0.0f, c.g) + std::max(0.0f, c.b)) / 3.0f;
}

/// Weights of r, g and b in the luminance of a colour.
Rgb luminance_weights(const RgbColorSpace& space);

}  // namespace nephroid
