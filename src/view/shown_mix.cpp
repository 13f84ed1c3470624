#include "view/shown_mix.h"

#include "core/errors.h"
#include "film/film_layers.h"
#include "view/comparisons.h"
#include "view/view_requests.h"

namespace nephroid {
namespace {

[[noreturn]] void throw_missing(const std::string& layer) {
  throw UsageError("mix: the picture has no layer '" + layer + "'");
}

/// Gain of a layer in a list; 1 if it is not in it.
Rgb gain_of(const std::vector<MixGain>& gains, const std::string& name) {
  for (const MixGain& gain : gains)
    if (gain.name == name) return gain.gain;
  return {1, 1, 1};
}

}  // namespace

LayerGains parse_shown_mix(std::string_view text, const std::vector<LiveLayer>& layers) {
  if (text.empty()) return {};
  MixLayers mixable;
  for (const LiveLayer& layer : layers) {
    if (layer.kind == LayerKind::kRoute) mixable.routes.push_back(layer.name);
    if (layer.kind == LayerKind::kLight) mixable.by_light.push_back({layer.name, {}, layer.name});
  }
  const Mix mix = parse_mix(text, mixable);
  if (!mix.lights.empty() && !mix.routes.empty())
    throw UsageError("mix: expected gains of routes or of lights, not of both");
  LayerGains gains;
  const LayerKind kind = mix.lights.empty() ? LayerKind::kRoute : LayerKind::kLight;
  if (mix.empty()) return gains;
  for (const LiveLayer& layer : layers)
    if (layer.kind == kind)
      gains.push_back(
          {layer.name, gain_of(mix.lights.empty() ? mix.routes : mix.lights, layer.name)});
  return gains;
}

Picture mixed_colors(const Film& film, const LayerGains& gains) {
  Picture picture = color_picture(film);
  if (gains.empty()) return picture;
  picture.pixels.assign(picture.pixels.size(), 0);
  for (const MixGain& gain : gains) {
    const std::vector<FilmLayer> found = film_layers(film, {gain.name});
    if (found.empty() || found[0].channels != "RGB") throw_missing(gain.name);
    const std::vector<float> values = layer_pixels(film, found[0]);
    for (size_t i = 0; i < values.size(); ++i)
      picture.pixels[i] += gain.gain[static_cast<int>(i % 3)] * values[i];
  }
  return picture;
}

Picture mixed_colors(const Picture& picture, const LayerGains& gains) {
  Picture colors = color_picture(picture);
  if (gains.empty()) return colors;
  colors.pixels.assign(colors.pixels.size(), 0);
  const size_t stride = picture.channels.size();
  for (const MixGain& gain : gains)
    for (int c = 0; c < 3; ++c) {
      const int channel = picture.find_channel(gain.name + "." + "RGB"[c]);
      if (channel < 0) throw_missing(gain.name);
      const float* value = &picture.pixels[static_cast<size_t>(channel)];
      for (size_t at = static_cast<size_t>(c); at < colors.pixels.size(); at += 3, value += stride)
        colors.pixels[at] += gain.gain[c] * *value;
    }
  return colors;
}

}  // namespace nephroid
