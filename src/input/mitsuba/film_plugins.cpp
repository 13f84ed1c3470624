#include "input/mitsuba/film_plugins.h"

#include <filesystem>
#include <iterator>
#include <utility>

#include "input/mitsuba/parameter_values.h"

namespace nephroid::mitsuba {
namespace {

using enum PluginSupport;

constexpr Plugin kFilms[] = {
    {"film", "hdrfilm"},
    {"film", "tiledhdrfilm"},
    {"film", "mfilm", kLoaded, "size and crop; the picture is an OpenEXR file"},
    {"film", "ldrfilm", kApproximated,
     "size and crop; the picture is linear, without tone mapping"},
    {"film", "specfilm", kApproximated, "the picture has colours, no spectra"},
};

struct FilterRow : Plugin {
  void (*write)(PluginProperties& properties, DirectiveDescription& filter) = nullptr;
};

void set_radius(DirectiveDescription& filter, double radius) {
  add_float(filter.parameters, "xradius", radius);
  add_float(filter.parameters, "yradius", radius);
}

void write_box(PluginProperties& p, DirectiveDescription& filter) {
  filter.type = "box";
  set_radius(filter, p.number("radius", 0.5));
}
void write_tent(PluginProperties& p, DirectiveDescription& filter) {
  filter.type = "triangle";
  set_radius(filter, p.number("radius", 1));
}
/// Mitsuba cuts the bell at four standard deviations and lowers it to 0 there, as pbrt-v4 does.
void write_gaussian(PluginProperties& p, DirectiveDescription& filter) {
  filter.type = "gaussian";
  const double sigma = p.number("stddev", 0.5);
  add_float(filter.parameters, "sigma", sigma);
  set_radius(filter, 4 * sigma);
}
void write_mitchell(PluginProperties& p, DirectiveDescription& filter) {
  filter.type = "mitchell";
  set_radius(filter, 2);
  add_float(filter.parameters, "B", p.number("b", 1.0 / 3.0));
  add_float(filter.parameters, "C", p.number("c", 1.0 / 3.0));
}
void write_catmull_rom(PluginProperties&, DirectiveDescription& filter) {
  filter.type = "mitchell";
  set_radius(filter, 2);
  add_float(filter.parameters, "B", 0);
  add_float(filter.parameters, "C", 0.5);
}
void write_lanczos(PluginProperties& p, DirectiveDescription& filter) {
  filter.type = "sinc";
  const int lobes = p.integer("lobes", 3);
  set_radius(filter, lobes);
  add_float(filter.parameters, "tau", lobes);
}

constexpr FilterRow kFilters[] = {
    {{"rfilter", "box"}, write_box},
    {{"rfilter", "tent"}, write_tent},
    {{"rfilter", "gaussian"}, write_gaussian},
    {{"rfilter", "mitchell"}, write_mitchell},
    {{"rfilter", "catmullrom"}, write_catmull_rom},
    {{"rfilter", "lanczos"}, write_lanczos},
};

void write_filter(ImportContext& context, const Object& object) {
  PluginProperties p(object, context);
  DirectiveDescription filter = directive("", object.where);
  plugin_row(kFilters, object, context.diagnostics).write(p, filter);
  p.report_unused();
  context.scene.pixel_filter = std::move(filter);
}

void write_default_filter(ImportContext& context, const SourceLocation& where) {
  DirectiveDescription filter = directive("gaussian", where);
  add_float(filter.parameters, "sigma", 0.5);
  set_radius(filter, 2);
  context.scene.pixel_filter = std::move(filter);
}

void add_crop(PluginProperties& p, ParameterSet& set, const FilmSize& size) {
  const int x = p.integer("crop_offset_x", 0), y = p.integer("crop_offset_y", 0);
  const int width = p.integer("crop_width", size.width),
            height = p.integer("crop_height", size.height);
  if (x < 0 || y < 0 || width < 1 || height < 1 || x > size.width - width ||
      y > size.height - height)
    throw SceneError(p.where(), "the crop lies outside of the film, expected a part of it");
  if (width == size.width && height == size.height) return;
  add_numbers(set, "integer", "pixelbounds",
              {double(x), double(x) + width, double(y), double(y) + height});
}

FilmSize read_film(ImportContext& context, const Object& object, DirectiveDescription& film) {
  PluginProperties p(object, context);
  plugin_row(kFilms, object, context.diagnostics);
  const FilmSize size{p.integer("width", 768), p.integer("height", 576)};
  constexpr int kMaxSize = 65536;
  if (size.width < 1 || size.height < 1 || size.width > kMaxSize || size.height > kMaxSize)
    throw SceneError(object.where, "the film has " + std::to_string(size.width) + " x " +
                                       std::to_string(size.height) +
                                       " pixels, expected 1 to 65536 in each direction");
  add_crop(p, film.parameters, size);
  if (object.type == "ldrfilm")
    for (const char* name : {"exposure", "gamma", "key", "burn", "tonemap_method"}) p.find(name);
  if (const Object* filter = p.first_child("rfilter")) write_filter(context, *filter);
  p.report_unused();
  return size;
}

}  // namespace

FilmSize write_film(PluginProperties& sensor, const std::string& scene_name) {
  ImportContext& context = sensor.context();
  const Object* object = sensor.first_child("film");
  DirectiveDescription film = directive("rgb", object ? object->where : sensor.where());
  write_default_filter(context, film.where);
  const FilmSize size = object ? read_film(context, *object, film) : FilmSize{768, 576};
  add_integer(film.parameters, "xresolution", size.width);
  add_integer(film.parameters, "yresolution", size.height);
  add_text(film.parameters, "filename", std::filesystem::path(scene_name).stem().string() + ".exr");
  context.scene.film = std::move(film);
  return size;
}

void write_sampler(PluginProperties& sensor) {
  const Object* object = sensor.first_child("sampler");
  if (!object) return;
  // The points are the program's own, whatever the plug-in.
  PluginProperties p(*object, sensor.context());
  const int samples = p.integer("sample_count", 4);
  if (samples < 1)
    throw SceneError(object->where,
                     "\"sample_count\" is below 1, expected at least 1 sample per pixel");
  DirectiveDescription sampler = directive("zsobol", object->where);
  add_integer(sampler.parameters, "pixelsamples", samples);
  const int seed = p.integer("seed", 0);
  if (seed != 0) add_integer(sampler.parameters, "seed", seed);
  for (const char* name : {"dimension", "scramble", "jitter", "samples_per_wavefront"})
    p.find(name);
  p.report_unused();
  sensor.context().scene.sampler = std::move(sampler);
}

std::vector<Plugin> film_plugins() {
  std::vector<Plugin> all(std::begin(kFilms), std::end(kFilms));
  all.insert(all.end(), std::begin(kFilters), std::end(kFilters));
  return all;
}

}  // namespace nephroid::mitsuba
