#include "scene/film_description.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.h"
#include "core/white_balance.h"
#include "input/spelling.h"

namespace nephroid {

namespace {

// The crop window in pixels: from the command line, in pixels, or in the unit square.
void set_crop(FilmDescription& film, const ParameterSet& p, const SceneOverrides& overrides) {
  const auto from_unit = [&](float x0, float x1, float y0, float y1) {
    const auto pixel = [](float u, int size) {
      return static_cast<int>(std::ceil(std::clamp(u, 0.0f, 1.0f) * static_cast<float>(size)));
    };
    film.crop_x0 = pixel(std::min(x0, x1), film.width);
    film.crop_x1 = pixel(std::max(x0, x1), film.width);
    film.crop_y0 = pixel(std::min(y0, y1), film.height);
    film.crop_y1 = pixel(std::max(y0, y1), film.height);
  };
  film.crop_x1 = film.width;
  film.crop_y1 = film.height;
  const std::vector<int> pixels = p.get_ints("pixelbounds");
  const std::vector<float> window = p.get_floats("cropwindow");
  if (overrides.has_crop) {
    const float* c = overrides.crop;
    from_unit(c[0], c[1], c[2], c[3]);
  } else if (!pixels.empty()) {
    if (pixels.size() != 4)
      throw SceneError(p.where, "\"pixelbounds\" expects 4 values (x0 x1 y0 y1)");
    film.crop_x0 = std::clamp(pixels[0], 0, film.width);
    film.crop_x1 = std::clamp(pixels[1], 0, film.width);
    film.crop_y0 = std::clamp(pixels[2], 0, film.height);
    film.crop_y1 = std::clamp(pixels[3], 0, film.height);
  } else if (!window.empty()) {
    if (window.size() != 4)
      throw SceneError(p.where, "\"cropwindow\" expects 4 values (x0 x1 y0 y1)");
    from_unit(window[0], window[1], window[2], window[3]);
  }
  if (film.crop_x0 < film.crop_x1 && film.crop_y0 < film.crop_y1) return;
  if (overrides.has_crop)
    throw UsageError(fmt::format(
        "--crop: the window contains no pixel of the {} x {} picture, expected a larger window",
        film.width, film.height));
  throw SceneError(p.where, "the crop window contains no pixel, expected a larger one");
}

constexpr FormatParameter kFilm[] = {
    {"string", "filename", "the scene file's name", "",
     "of the picture, without folders; ends in .exr"},
    {"integer", "xresolution", "1280", "pixels", "1 to 65536"},
    {"integer", "yresolution", "720", "pixels", "1 to 65536"},
    {"integer[4]", "pixelbounds", "the full picture", "pixels", "x0 x1 y0 y1"},
    {"float[4]", "cropwindow", "0 1 0 1", "", "x0 x1 y0 y1; pixelbounds wins"},
    {"float", "diagonal", "35", "mm", "of the realistic camera's film"},
    {"bool", "savefp16", "true", "", "each layer has the precision that it needs",
     Support::kNotNeeded},
    {"float", "iso", "100"},
    {"float", "whitebalance", "0, of measured sensors 6500", "K", "0 or 500 to 100000"},
    {"string", "sensor", "cie1931", "",
     "a measured sensor is rendered as cie1931 with its exposure, with a warning"},
    {"float", "maxcomponentvalue", "infinity", "", "samples are scaled down to it; above 0"},
};
constexpr FormatParameter kGBuffer[] = {
    {"string", "coordinatesystem", "camera", "", "camera or world"}};
constexpr FormatParameter kSpectral[] = {
    {"integer", "nbuckets", "16"},
    {"float", "lambdamin", "360", "nm"},
    {"float", "lambdamax", "830", "nm"},
};
constexpr FormatType kFilms[] = {
    {"rgb", {kFilm}},
    {"gbuffer", {kFilm, kGBuffer}, "rgb and further layers"},
    {"spectral", {kFilm, kSpectral}, "the film keeps colours, no spectra", Support::kRefused},
};

/// The coordinate system of a gbuffer film's layers.
GBufferSpace read_type(const DirectiveDescription& d) {
  if (row_of(kFilms, "film", d.type, d.where).name != std::string("gbuffer"))
    return GBufferSpace::kNone;
  const std::string system = d.parameters.get_string("coordinatesystem", "camera");
  if (system == "camera") return GBufferSpace::kCamera;
  if (system == "world") return GBufferSpace::kWorld;
  throw SceneError(
      d.parameters.find("coordinatesystem")->where,
      "unknown coordinate system \"" + system + "\" of the film, expected \"camera\" or \"world\"");
}

float positive(const ParameterSet& p, const char* name, float fallback) {
  const float value = p.get_float(name, fallback);
  if (!(value > 0))
    throw SceneError(p.find(name)->where,
                     "\"" + std::string(name) + "\" of the film must be above 0");
  return value;
}

// The sensors of the format's table of measured cameras.
constexpr const char* kMeasuredSensors[] = {
    "canon_eos_100d", "canon_eos_1dx_mkii", "canon_eos_200d",     "canon_eos_200d_mkii",
    "canon_eos_5d",   "canon_eos_5d_mkii",  "canon_eos_5d_mkiii", "canon_eos_5d_mkiv",
    "canon_eos_5ds",  "canon_eos_m",        "hasselblad_l1d_20c", "nikon_d810",
    "nikon_d850",     "sony_ilce_6400",     "sony_ilce_7m3",      "sony_ilce_7rm3",
    "sony_ilce_9"};

// A measured sensor is approximated by cie1931: grey under its white gets the same brightness, and
// the balance is 6500 K unless the scene sets it. Its colour rendition is lost.
void set_sensor(FilmDescription& film, const ParameterSet& p, Diagnostics& diagnostics) {
  const std::string sensor = p.get_string("sensor", "cie1931");
  float kelvin = p.get_float("whitebalance", 0.0f);
  if (kelvin != 0 && !(kelvin >= 500 && kelvin <= 100000))
    throw SceneError(p.find("whitebalance")->where,
                     "\"whitebalance\" must be 0 or a temperature from 500 to 100000 K");
  if (sensor != "cie1931") {
    const std::vector<std::string> known(std::begin(kMeasuredSensors), std::end(kMeasuredSensors));
    if (std::find(known.begin(), known.end(), sensor) == known.end())
      throw SceneError(p.find("sensor")->where,
                       "unknown sensor \"" + sensor + "\"" + did_you_mean(sensor, known) +
                           " (expected \"cie1931\" or a sensor of pbrt-v4)");
    diagnostics.warn(p.find("sensor")->where,
                     "sensor \"" + sensor + "\" is rendered as \"cie1931\" with its exposure");
    if (kelvin == 0) kelvin = 6500;
  }
  if (kelvin != 0) film.white_balance = white_balance(*film.color_space, kelvin);
}

}  // namespace

std::vector<FormatType> film_types() {
  return format_types(kFilms);
}

FilmDescription make_film_description(const SceneDescription& description,
                                      const SceneOverrides& overrides, Diagnostics& diagnostics) {
  static const ParameterSet kNone;
  const ParameterSet& p = description.film ? description.film->parameters : kNone;
  FilmDescription film;
  if (description.film) film.gbuffer = read_type(*description.film);
  film.width = overrides.width > 0 ? overrides.width : p.get_int("xresolution", 1280);
  film.height = overrides.height > 0 ? overrides.height : p.get_int("yresolution", 720);
  if (overrides.width > 0) (void)p.find("xresolution");
  if (overrides.height > 0) (void)p.find("yresolution");
  film.where = p.where;
  if (film.width < 1 || film.height < 1 || film.width > 65536 || film.height > 65536)
    throw SceneError(p.where, "the resolution " + std::to_string(film.width) + " x " +
                                  std::to_string(film.height) + " must lie in 1..65536");
  set_crop(film, p, overrides);

  // Exposure: the shutter is set in the Camera directive, the rest in the Film (pbrt-v4 section
  // 5.4).
  float exposure = 1;
  if (description.camera) {
    const ParameterSet& c = description.camera->parameters;
    exposure = c.get_float("shutterclose", 1.0f) - c.get_float("shutteropen", 0.0f);
    if (!(exposure > 0))
      throw SceneError(c.where, "\"shutterclose\" must be later than \"shutteropen\"");
  }
  film.imaging_ratio = exposure * positive(p, "iso", 100.0f) / 100.0f;
  film.max_component = positive(p, "maxcomponentvalue", kInfinity);
  film.color_space = RgbColorSpace::find(description.color_space);
  set_sensor(film, p, diagnostics);
  film.filename = p.get_string("filename", "");
  film.diagonal_mm = positive(p, "diagonal", 35.0f);
  if (description.film) {
    const std::string& type = description.film->type;
    p.report_unused("film \"" + type + "\"", *find_row(kFilms, type), diagnostics);
  }
  return film;
}

}  // namespace nephroid
