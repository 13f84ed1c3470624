#include "scene/film_description.h"

namespace nephroid {

namespace {

// The crop window in pixels: given by the command line, in pixels, or in the unit square.
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
  if (film.crop_x0 >= film.crop_x1 || film.crop_y0 >= film.crop_y1)
    throw SceneError(p.where, "the crop window contains no pixel");
}

void check_type(const DirectiveDescription& d, Diagnostics& diagnostics) {
  if (d.type == "rgb") return;
  if (d.type == "gbuffer") {
    diagnostics.warn(d.where,
                     "film \"gbuffer\" is rendered as \"rgb\" with this program's own layers");
    return;
  }
  throw SceneError(d.where, d.type == "spectral"
                                ? "film \"spectral\" is not rendered yet, expected \"rgb\""
                                : "unknown film \"" + d.type + "\", expected \"rgb\"");
}

float positive(const ParameterSet& p, const char* name, float fallback) {
  const float value = p.get_float(name, fallback);
  if (!(value > 0))
    throw SceneError(p.find(name)->where,
                     "\"" + std::string(name) + "\" of the film must be above 0");
  return value;
}

}  // namespace

FilmDescription make_film_description(const SceneDescription& description,
                                      const SceneOverrides& overrides, Diagnostics& diagnostics) {
  static const ParameterSet kNone;
  const ParameterSet& p = description.film ? description.film->parameters : kNone;
  if (description.film) check_type(*description.film, diagnostics);
  FilmDescription film;
  film.width = overrides.width > 0 ? overrides.width : p.get_int("xresolution", 1280);
  film.height = overrides.height > 0 ? overrides.height : p.get_int("yresolution", 720);
  if (overrides.width > 0) (void)p.find("xresolution");
  if (overrides.height > 0) (void)p.find("yresolution");
  film.where = p.where;
  if (film.width < 1 || film.height < 1 || film.width > 65536 || film.height > 65536)
    throw SceneError(p.where, "the resolution " + std::to_string(film.width) + " x " +
                                  std::to_string(film.height) + " must lie in 1..65536");
  set_crop(film, p, overrides);

  // Exposure: the shutter stands in the Camera directive, the rest in the Film (pbrt-v4
  // section 5.4).
  float exposure = 1;
  if (description.camera) {
    const ParameterSet& c = description.camera->parameters;
    exposure = c.get_float("shutterclose", 1.0f) - c.get_float("shutteropen", 0.0f);
    if (!(exposure > 0))
      throw SceneError(c.where, "\"shutterclose\" must be later than \"shutteropen\"");
  }
  film.imaging_ratio = exposure * positive(p, "iso", 100.0f) / 100.0f;
  const std::string sensor = p.get_string("sensor", "cie1931");
  if (sensor != "cie1931")
    diagnostics.warn(p.where, "sensor \"" + sensor + "\" is rendered as \"cie1931\"");
  if (p.get_float("whitebalance", 0.0f) != 0.0f)
    diagnostics.warn(p.where, "\"whitebalance\" is not rendered yet");
  film.max_component = positive(p, "maxcomponentvalue", kInfinity);
  film.color_space = RgbColorSpace::find(description.color_space);
  film.filename = p.get_string("filename", "nephroid.exr");
  film.diagonal_mm = positive(p, "diagonal", 35.0f);
  (void)p.get_bool("savefp16", true);
  if (description.film) p.report_unused("film \"" + description.film->type + "\"", diagnostics);
  return film;
}

}  // namespace nephroid
