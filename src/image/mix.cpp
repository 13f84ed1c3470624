// A mix is a matrix: each channel of the result is a weighted sum of channels of the picture.
#include "image/mix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "core/parallel.h"
#include "film/metadata_keys.h"
#include "image/mix_text.h"
#include "input/option_values.h"
#include "input/spelling.h"

namespace nephroid {
namespace {

constexpr std::array<char, 3> kLetters = {'R', 'G', 'B'};
/// Layers that do not depend on light.
constexpr std::array<std::string_view, 5> kFeatureLayers = {"albedo", "Albedo", "N", "Ns", "P"};
constexpr std::array<std::string_view, 6> kFeatureChannels = {"Z",    "u",    "v",
                                                              "dzdx", "dzdy", "samples"};
constexpr int64_t kMixRowsPerChunk = 16;
constexpr float kMaxGain = 1e6f;

/// A layer that is added, and its gain.
struct Term {
  std::string layer, route, light;  ///< route or light is empty if the layer has all of them
  Rgb gain{1, 1, 1};
};

bool has_layer(const PictureHead& picture, const std::string& name) {
  return std::ranges::all_of(kLetters, [&](char letter) {
    return std::ranges::find(picture.channels, name + "." + letter) != picture.channels.end();
  });
}

Rgb operator*(const Rgb& a, const Rgb& b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

/// The gain of that name, 1 if it has none.
Rgb gain_of(const std::vector<MixGain>& gains, const std::string& name) {
  const auto found = std::ranges::find(gains, name, &MixGain::name);
  return found == gains.end() ? Rgb{1, 1, 1} : found->gain;
}

/// Throws UsageError for a name that is unknown or given twice. `kind` is "light" or "route".
void check_names(const std::string& kind, const std::vector<MixGain>& gains,
                 const std::vector<std::string>& known) {
  for (size_t i = 0; i < gains.size(); ++i) {
    const std::string& name = gains[i].name;
    if (std::ranges::find(known, name) == known.end())
      throw UsageError(fmt::format("--{}: the picture has no {} '{}', expected one of: {}{}", kind,
                                   kind, name, fmt::join(known, ", "), did_you_mean(name, known)));
    for (size_t k = 0; k < i; ++k)
      if (gains[k].name == name)
        throw UsageError(fmt::format("--{}: '{}' is given twice, expected once", kind, name));
  }
}

std::vector<std::string> lights_of(const std::vector<LayerByLight>& layers) {
  std::vector<std::string> lights;
  for (const LayerByLight& layer : layers)
    if (std::ranges::find(lights, layer.light) == lights.end()) lights.push_back(layer.light);
  return lights;
}

/// The layers to add for a mix. Throws UsageError if the picture lacks them.
std::vector<LayerByLight> layers_to_add(const MixLayers& layers, const Mix& mix) {
  const bool has_both = !layers.by_route_and_light.empty();
  if (!mix.lights.empty() && !mix.routes.empty()) {
    if (has_both) return layers.by_route_and_light;
    throw UsageError(
        "--light and --route: the picture has no layer for each route and light, expected one "
        "rendered with --layers both, or gains of lights or of routes alone");
  }
  if (!mix.lights.empty()) {
    if (!layers.by_light.empty()) return layers.by_light;
    if (has_both) return layers.by_route_and_light;
    throw UsageError(
        "--light: the picture has no layers by light, expected one rendered with --layers lights "
        "or --layers both");
  }
  if (layers.routes.empty())
    throw UsageError(
        "--route: the picture has no layers by route, expected one that nephroid render wrote");
  std::vector<LayerByLight> by_route;
  for (const std::string& route : layers.routes) by_route.push_back({route, route, {}});
  return by_route;
}

std::vector<Term> terms_of(const MixLayers& layers, const Mix& mix) {
  const std::vector<LayerByLight> added = layers_to_add(layers, mix);
  check_names("light", mix.lights, lights_of(added));
  check_names("route", mix.routes, layers.routes);
  std::vector<Term> terms;
  for (const LayerByLight& layer : added)
    terms.push_back({layer.layer, layer.route, layer.light,
                     gain_of(mix.routes, layer.route) * gain_of(mix.lights, layer.light)});
  return terms;
}

/// A channel of the result.
struct MixedChannel {
  struct Source {
    size_t channel = 0;  ///< of the picture
    double gain = 1;
  };
  std::string name;
  std::vector<Source> sources;
};

class ChannelPlan {
 public:
  explicit ChannelPlan(const Picture& picture) : picture_(picture) {}

  /// A layer of the result: the sum of those terms that `is_added` accepts.
  template <class Accept>
  void add_layer(const std::string& name, const std::vector<Term>& terms, const Accept& is_added) {
    for (int c = 0; c < 3; ++c) {
      const std::string letter(1, kLetters[static_cast<size_t>(c)]);
      MixedChannel channel{name.empty() ? letter : name + "." + letter, {}};
      for (const Term& term : terms)
        if (is_added(term))
          channel.sources.push_back({index_of(term.layer + "." + letter), double{term.gain[c]}});
      channels_.push_back(std::move(channel));
    }
  }
  void keep_features() {
    for (size_t i = 0; i < picture_.channels.size(); ++i) {
      const std::string_view name = picture_.channels[i];
      const size_t dot = name.rfind('.');
      const bool is_feature =
          dot == std::string_view::npos
              ? std::ranges::find(kFeatureChannels, name) != kFeatureChannels.end()
              : std::ranges::find(kFeatureLayers, name.substr(0, dot)) != kFeatureLayers.end();
      if (is_feature) channels_.push_back({std::string(name), {{i, 1}}});
    }
  }
  const std::vector<MixedChannel>& channels() const { return channels_; }

 private:
  size_t index_of(const std::string& channel) const {
    return static_cast<size_t>(picture_.find_channel(channel));
  }
  const Picture& picture_;
  std::vector<MixedChannel> channels_;
};

std::vector<MixedChannel> channels_of(const Picture& picture, const MixLayers& layers,
                                      const std::vector<Term>& terms) {
  ChannelPlan plan(picture);
  plan.add_layer("", terms, [](const Term&) { return true; });
  const bool by_both = !terms.empty() && !terms[0].route.empty() && !terms[0].light.empty();
  if (by_both)
    for (const std::string& route : layers.routes)
      plan.add_layer(route, terms, [&](const Term& term) { return term.route == route; });
  for (const Term& term : terms)
    plan.add_layer(term.layer, {term}, [](const Term&) { return true; });
  plan.keep_features();
  return plan.channels();
}

std::vector<float> pixels_of(const Picture& picture, const std::vector<MixedChannel>& channels) {
  const size_t in_width = picture.channels.size(), out_width = channels.size();
  const size_t row = static_cast<size_t>(picture.width());
  std::vector<float> pixels(row * static_cast<size_t>(picture.height()) * out_width);
  parallel_chunks(picture.height(), kMixRowsPerChunk, [&](int64_t, int64_t begin, int64_t end) {
    for (size_t i = static_cast<size_t>(begin) * row; i < static_cast<size_t>(end) * row; ++i)
      for (size_t c = 0; c < out_width; ++c) {
        double sum = 0;
        for (const MixedChannel::Source& source : channels[c].sources)
          sum += source.gain * double{picture.pixels[i * in_width + source.channel]};
        pixels[i * out_width + c] = static_cast<float>(sum);
      }
  });
  return pixels;
}

void set_value(Metadata* metadata, const char* key, const std::string& value) {
  std::erase_if(*metadata, [&](const auto& entry) { return entry.first == key; });
  if (!value.empty()) metadata->emplace_back(key, value);
}

/// The gains of all lights and all routes that a mix divides the picture by.
MixGains gains_of(const MixLayers& layers, const std::vector<Term>& terms, const Mix& mix) {
  MixGains gains;
  std::vector<LayerByLight> added;
  for (const Term& term : terms) added.push_back({term.layer, term.route, term.light});
  for (const std::string& light : lights_of(added))
    if (!light.empty()) gains.push_back({"light", {light, gain_of(mix.lights, light)}});
  if (!terms[0].route.empty())
    for (const std::string& route : layers.routes)
      gains.push_back({"route", {route, gain_of(mix.routes, route)}});
  return gains;
}

Metadata metadata_of(const Picture& picture, const MixLayers& layers,
                     const std::vector<Term>& terms, const Mix& mix) {
  Metadata metadata = picture.metadata;
  std::vector<LayerByLight> kept;
  for (const Term& term : terms)
    if (!term.light.empty()) kept.push_back({term.layer, term.route, term.light});
  set_value(&metadata, kLayersByLightKey, layers_by_light_text(kept));
  const MixGains before = parse_mix_text(value_of(picture.metadata, kMixKey));
  set_value(&metadata, kMixKey, mix_text(product(before, gains_of(layers, terms, mix))));
  set_value(&metadata, kChoicesKey, {});  // it tells of the light before
  return metadata;
}

}  // namespace

MixGain parse_mix_gain(const std::string& option, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw UsageError(option + ": '" + text +
                     "' is not valid, expected a name and its gain as in key=2 or key=1,0.9,0.8");
  const std::string name = text.substr(0, equals);
  std::vector<float> numbers;
  std::istringstream words(text.substr(equals + 1) + ",");
  for (std::string word; std::getline(words, word, ',');)
    numbers.push_back(parse_float(option + " " + name, word, 0, kMaxGain, false));
  if (numbers.size() != 1 && numbers.size() != 3)
    throw UsageError(fmt::format(
        "{} {}: {} numbers are given, expected one gain, or three for red, green and blue", option,
        name, numbers.size()));
  return {name, {numbers.front(), numbers[numbers.size() / 2], numbers.back()}};
}

MixLayers mix_layers(const PictureHead& picture) {
  MixLayers layers;
  std::istringstream routes(value_of(picture.metadata, kRoutesKey));
  for (std::string line; std::getline(routes, line);)
    if (const std::string name = line.substr(0, line.find(" = ")); has_layer(picture, name))
      layers.routes.push_back(name);
  for (LayerByLight& layer : parse_layers_by_light(value_of(picture.metadata, kLayersByLightKey)))
    if (has_layer(picture, layer.layer))
      (layer.route.empty() ? layers.by_light : layers.by_route_and_light)
          .push_back(std::move(layer));
  return layers;
}

std::vector<std::string> inexact_mix_reasons(bool clamps_samples, bool rejects_outliers) {
  std::vector<std::string> reasons;
  if (clamps_samples)
    reasons.emplace_back(
        "samples are clamped (maxcomponentvalue of the Film): with other gains, others would be");
  if (rejects_outliers)
    reasons.emplace_back(
        "outliers are rejected (--outliers reject): with other gains, others would be");
  return reasons;
}

std::vector<std::string> inexact_mix_reasons(const Metadata& picture) {
  return inexact_mix_reasons(!value_of(picture, kMaxComponentKey).empty(),
                             value_of(picture, kOutliersKey) == "reject");
}

Picture mixed(const Picture& picture, const Mix& mix) {
  const MixLayers layers = mix_layers(picture);
  const std::vector<Term> terms = terms_of(layers, mix);
  const std::vector<MixedChannel> channels = channels_of(picture, layers, terms);
  Picture result;
  static_cast<PictureHead&>(result) = picture;
  result.channels.clear();
  for (const MixedChannel& channel : channels) result.channels.push_back(channel.name);
  result.metadata = metadata_of(picture, layers, terms, mix);
  result.pixels = pixels_of(picture, channels);
  return result;
}

}  // namespace nephroid
