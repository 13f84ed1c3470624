#include "view/describe_render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "film/film_layers.h"
#include "image/mix.h"
#include "scene/camera/camera.h"
#include "view/frame.h"

namespace nephroid {
namespace {

/// Layers of lamps by route are not mixed on the page: those of lamps and of routes are.
LayerKind kind_of(const std::string& name, const FilmLayout& layout,
                  const std::vector<LayerByLight>& lights) {
  if (name == kPictureLayer) return LayerKind::kPicture;
  if (std::ranges::find(layout.routes, name) != layout.routes.end()) return LayerKind::kRoute;
  const auto light = std::ranges::find(lights, name, &LayerByLight::layer);
  if (light != lights.end() && light->route.empty()) return LayerKind::kLight;
  if (std::ranges::find(layout.aovs, name) != layout.aovs.end()) return LayerKind::kAov;
  return LayerKind::kFeature;
}

std::vector<LiveLayer> layers_of(const Render& render) {
  const Film& film = render.film();
  const std::vector<LayerByLight> lights = layers_by_light(render.plan());
  std::vector<LiveLayer> layers;
  for (const FilmLayer& layer : film_layers(film))
    layers.push_back({layer.name, kind_of(layer.name, film.layout(), lights), layer.channels});
  return layers;
}

}  // namespace

void apply(const RenderChange& change, RenderRequest* request) {
  if (change.integrator) {
    request->routes.integrator = *change.integrator;
    request->routes.preset_or_file.clear();
    request->routes.routes.clear();
  }
  if (change.routes) {
    request->routes.preset_or_file = *change.routes;
    request->routes.routes.clear();
    if (!change.routes->empty()) request->routes.integrator.clear();
  }
  if (change.layers) request->routes.layers = *change.layers;
  if (change.seed) request->seed = *change.seed;
  if (change.time) request->options.time_limit = *change.time;
  if (change.noise) request->options.noise_target = *change.noise;
  if (change.resolution) {
    request->overrides.width = change.resolution->first;
    request->overrides.height = change.resolution->second;
  }
  if (change.crop) {
    request->overrides.has_crop = true;
    for (int i = 0; i < 4; ++i)
      request->overrides.crop[i] = static_cast<float>((*change.crop)[static_cast<size_t>(i)]);
  }
}

void describe(const Render& render, const LoadedScene& loaded, bool is_preview, LiveState* state) {
  const Film& film = render.film();
  state->is_preview = is_preview;
  state->width = film.settings().width;
  state->height = film.settings().height;
  state->window = film.bounds();
  state->progress = {};
  // A preview has no layers of its own.
  if (is_preview) return;
  state->layers = layers_of(render);
  const bool clamps = film.settings().max_component < kInfinity;
  state->why_mix_is_inexact = joined(inexact_mix_reasons(clamps, film.rejection() != nullptr));
  state->notes = render.notes();
  state->report.clear();
  state->is_mirrored = loaded.scene->camera->camera_to_world(0).m.determinant() < 0;
  state->camera_type = loaded.description.camera ? loaded.description.camera->type : "perspective";
}

LiveSettings settings_of(const RenderRequest& request, const Render& render, const Scene& scene,
                         const FilmDescription& full) {
  LiveSettings settings;
  settings.integrator = request.routes.integrator_or(render.integrator().name);
  settings.routes = request.routes.preset_or_file;
  settings.layers = request.routes.layers;
  settings.seed = request.seed.value_or(scene.scene_seed);
  settings.time_limit = request.options.time_limit;
  settings.noise_target = request.options.noise_target;
  settings.width = full.width;
  settings.height = full.height;
  const double crop[4] = {1.0 * full.crop_x0 / full.width, 1.0 * full.crop_x1 / full.width,
                          1.0 * full.crop_y0 / full.height, 1.0 * full.crop_y1 / full.height};
  std::copy(std::begin(crop), std::end(crop), std::begin(settings.crop));
  return settings;
}

std::vector<std::string> known_layers(const std::vector<LiveLayer>& layers,
                                      const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const std::string& name : names)
    if (std::ranges::find(layers, name, &LiveLayer::name) != layers.end()) known.push_back(name);
  return known;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& reasons) {
  return fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace nephroid
