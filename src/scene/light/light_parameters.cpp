// Parameters common to all lights: colour, photometric scale, image; see light_table.h.
#include <fmt/format.h>

#include "scene/light/cube_map.h"
#include "scene/light/light_table.h"
#include "scene/light/sphere_map.h"

namespace nephroid {

namespace {

float read_scale(const ParameterSet& parameters) {
  const float scale = parameters.get_float("scale", 1.0f);
  if (!(scale >= 0.0f) || !std::isfinite(scale))
    throw SceneError(parameters.find("scale")->where,
                     "a light's \"scale\" must be a number that is not negative");
  return scale;
}

/// Larger scales make products with spectra and pixels overflow floats.
constexpr float kLargestScale = 1e30f;

/// The illuminant of a colour space; the spaces live as long as the program.
SpectrumPtr illuminant_of(const std::string& color_space) {
  const RgbColorSpace* space = RgbColorSpace::find(color_space);
  return {std::shared_ptr<const void>(), &(space ? *space : RgbColorSpace::srgb()).illuminant()};
}

/// Illuminance by the map's +z hemisphere, in units of its illuminant and of a pixel's mean solid
/// angle.
double illuminance_of(const Image& image) {
  const Rgb luminance = luminance_weights(image.color_space());
  const SphereMap map(image.width(), image.height());
  const float step_x = 1.0f / static_cast<float>(image.width());
  const float step_y = 1.0f / static_cast<float>(image.height());
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Vec2f centre((static_cast<float>(x) + 0.5f) * step_x,
                         (static_cast<float>(y) + 0.5f) * step_y);
      const float cosine = map.direction(centre).z * map.relative_solid_angle(y);
      if (cosine <= 0.0f) continue;
      const Rgb c = image.texel(x, y, WrapMode::kClamp);
      sum += (c.r * luminance.r + c.g * luminance.g + c.b * luminance.b) * cosine;
    }
  return sum;
}

void check_emitted(const Image& image, const std::string& path, const SourceLocation& wanted_by) {
  // Limit with room for the light's area, which multiplies the radiance.
  constexpr float kBrightest = 1e30f;
  if (const float largest = image.largest_value(); !(largest <= kBrightest))
    throw SceneError(wanted_by,
                     "image \"" + path + "\" has " +
                         (std::isfinite(largest) ? "values above 1e30" : "infinite or NaN values") +
                         ", which cannot be emitted");
}

/// The map of the six images that "faces" names.
ImagePtr read_cube(const Parameter& names, SceneFiles& files) {
  CubeFaces faces;
  if (names.strings.size() != faces.size())
    throw SceneError(names.where, "\"faces\" has " + std::to_string(names.strings.size()) +
                                      " names, expected 6 images: +x, -x, +y, -y, +z and -z");
  for (size_t i = 0; i < faces.size(); ++i) {
    const FileSource source = files.source_of(names.strings[i]);
    faces[i] = read_cube_face(source, names.where);
    check_emitted(*faces[i], source.path, names.where);
    if (faces[i]->width() != faces[0]->width())
      throw SceneError(names.where,
                       "the faces of the cube have " + std::to_string(faces[0]->width()) + " and " +
                           std::to_string(faces[i]->width()) + " pixels a side, expected one size");
  }
  return latitude_longitude_map(faces);
}

}  // namespace

EmissionColor read_emission(const ParameterSet& parameters, const std::string& name,
                            SceneFiles& files, const std::string& color_space) {
  EmissionColor e;
  const Parameter* colour = parameters.find(name);
  if (colour)
    e.spectrum = spectrum_from_parameter(*colour, SpectrumKind::kIlluminant, files);
  else
    // All parameters of a directive share the colour space that was set when it was read.
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
  const float scale = read_scale(parameters) / spectrum_to_photometric(space.illuminant());
  if (!(scale <= kLargestScale))
    throw SceneError(parameters.find("scale")->where,
                     "\"scale\" makes the light too bright for floating-point numbers, expected at "
                     "most 1e30");
  return scale;
}

float scale_to(const Parameter& wanted, float value, double unscaled, float scale) {
  if (!(unscaled > 0.0)) return 0.0f;
  const double scaled = static_cast<double>(scale) * value / unscaled;
  if (!(scaled <= kLargestScale))
    throw SceneError(wanted.where,
                     "the light would have to be scaled by more than 1e30 to emit this \"" +
                         wanted.name + "\", expected a smaller value or a brighter \"L\" or image");
  return static_cast<float>(scaled);
}

void warn_of_unused_flux(const ParameterSet& parameters, Diagnostics& diagnostics) {
  for (const char* name : {"power", "illuminance"}) {
    const Parameter* flux = parameters.peek(name);
    if (!flux || !flux->used || flux->numbers.size() != 1 || flux->numbers[0] == -1) continue;
    if (!(static_cast<float>(flux->numbers[0]) > 0.0f))
      diagnostics.warn(flux->where, fmt::format("\"{}\" is {} and so not used, expected a value "
                                                "above 0; \"scale\" 0 turns a light off",
                                                name, flux->numbers[0]));
  }
}

ImagePtr read_light_image(const ParameterSet& parameters, SceneFiles& files) {
  const Parameter& p = *parameters.find("filename");
  const FileSource source = files.source_of(parameters.get_string("filename", ""));
  ImagePtr image = read_image(source, std::nullopt, p.where);
  check_emitted(*image, source.path, p.where);
  return image;
}

ImagePtr read_sphere_image(const ParameterSet& parameters, SceneFiles& files,
                           const std::string& of_what) {
  ImagePtr image = read_light_image(parameters, files);
  if (image->width() != image->height())
    throw SceneError(parameters.find("filename")->where,
                     "the image of " + of_what + " is " + std::to_string(image->width()) + " x " +
                         std::to_string(image->height()) +
                         ", expected a square: an equal-area octahedral map (pbrt-v4's \"imgtool "
                         "makeequiarea\" converts latitude-longitude maps)");
  return image;
}

ImagePtr read_environment_image(const ParameterSet& parameters, SceneFiles& files) {
  if (const Parameter* faces = parameters.find("faces", {"string"}))
    return read_cube(*faces, files);
  ImagePtr image = read_light_image(parameters, files);
  if (image->width() != image->height() && image->width() != 2 * image->height())
    throw SceneError(parameters.find("filename")->where,
                     "the image of an infinite light is " + std::to_string(image->width()) + " x " +
                         std::to_string(image->height()) +
                         ", expected a square (an equal-area octahedral map) or twice the width of "
                         "the height (a latitude-longitude map)");
  return image;
}

float sphere_emission_scale(const ParameterSet& parameters, const Image& image) {
  const float scale = image_emission_scale(parameters, image.color_space());
  const float illuminance = parameters.get_float("illuminance", -1.0f);
  if (!(illuminance > 0.0f)) return scale;
  // The factor is pbrt-v4's, which assigns each of the n pixels 2 pi / n of solid angle on average.
  const double per_pixel = 2.0 * kPi / (static_cast<double>(image.width()) * image.height());
  return scale_to(*parameters.find("illuminance"), illuminance, illuminance_of(image) * per_pixel,
                  scale);
}

Rgb luminance_weights(const RgbColorSpace& space) {
  return {space.to_xyz({1, 0, 0}).y, space.to_xyz({0, 1, 0}).y, space.to_xyz({0, 0, 1}).y};
}

}  // namespace nephroid
