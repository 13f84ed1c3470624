// What the parameters of all lights have in common: colour, photometric scale, image. See
// light_table.h.
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

float read_scale(const ParameterSet& parameters) {
  const float scale = parameters.get_float("scale", 1.0f);
  if (!(scale >= 0.0f) || !std::isfinite(scale))
    throw SceneError(parameters.find("scale")->where,
                     "a light's \"scale\" must be a number that is not negative");
  return scale;
}

/// The illuminant of a colour space; the spaces live as long as the program.
SpectrumPtr illuminant_of(const std::string& color_space) {
  const RgbColorSpace* space = RgbColorSpace::find(color_space);
  return {std::shared_ptr<const void>(), &(space ? *space : RgbColorSpace::srgb()).illuminant()};
}

}  // namespace

Emission read_emission(const ParameterSet& parameters, const std::string& name,
                       const std::string& directory, const std::string& color_space) {
  Emission e;
  const Parameter* colour = parameters.find(name);
  if (colour)
    e.spectrum = spectrum_from_parameter(*colour, SpectrumKind::kIlluminant, directory);
  else
    // The parameters of a directive share the colour space that was in force at it.
    e.spectrum =
        illuminant_of(parameters.list.empty() ? color_space : parameters.list.front().color_space);
  const float luminance = spectrum_to_photometric(*e.spectrum);
  e.scale = luminance > 0.0f ? read_scale(parameters) / luminance : 0.0f;
  if (!std::isfinite(e.scale * e.spectrum->max_value()))
    throw SceneError(colour ? colour->where : parameters.where,
                     "the light is too bright for floating-point numbers, expected less than 1e38");
  return e;
}

float image_emission_scale(const ParameterSet& parameters, const RgbColorSpace& space) {
  return read_scale(parameters) / spectrum_to_photometric(space.illuminant());
}

ImagePtr read_light_image(const ParameterSet& parameters, const std::string& directory) {
  const Parameter& p = *parameters.find("filename");
  const std::string path = resolve_path(directory, parameters.get_string("filename", ""));
  ImagePtr image = read_image(path, std::nullopt, p.where);
  if (!image->is_finite())
    throw SceneError(p.where,
                     "image \"" + path + "\" has infinite or NaN values, which cannot be emitted");
  return image;
}

Rgb luminance_weights(const RgbColorSpace& space) {
  return {space.to_xyz({1, 0, 0}).y, space.to_xyz({0, 1, 0}).y, space.to_xyz({0, 0, 1}).y};
}

}  // namespace nephroid
