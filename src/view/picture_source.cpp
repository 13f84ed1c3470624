#include "view/picture_source.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/errors.h"
#include "film/film_output.h"
#include "image/mix.h"
#include "session/checkpoint/render_identity.h"
#include "view/comparisons.h"
#include "view/describe_render.h"

namespace nephroid {
namespace {

constexpr const char* kSamples = "samples";

/// A layer's channels in the file.
std::vector<std::string> channels_of(const LiveLayer& layer) {
  if (layer.name == kSamples) return {layer.name};
  const bool is_plain = layer.name == kPictureLayer || layer.name == "Z";
  std::vector<std::string> channels;
  for (const char letter : layer.channels)
    channels.push_back((is_plain ? "" : layer.name + ".") + letter);
  return channels;
}

LayerKind kind_of(const std::string& name, const MixLayers& mixable) {
  if (std::ranges::find(mixable.routes, name) != mixable.routes.end()) return LayerKind::kRoute;
  if (std::ranges::find(mixable.by_light, name, &LayerByLight::layer) != mixable.by_light.end())
    return LayerKind::kLight;
  return LayerKind::kFeature;
}

std::vector<LiveLayer> layers_of(const Picture& picture) {
  const MixLayers mixable = mix_layers(picture);
  std::vector<LiveLayer> layers{{kPictureLayer, LayerKind::kPicture, "RGB"}};
  for (const std::string& channel : picture.channels) {
    const size_t dot = channel.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string name = channel.substr(0, dot), letter = channel.substr(dot + 1);
    if (letter == "R" && picture.find_channel(name + ".G") >= 0 &&
        picture.find_channel(name + ".B") >= 0)
      layers.push_back({name, kind_of(name, mixable), "RGB"});
    if (letter == "X" && picture.find_channel(name + ".Y") >= 0 &&
        picture.find_channel(name + ".Z") >= 0)
      layers.push_back({name, LayerKind::kFeature, "XYZ"});
  }
  if (picture.find_channel("Z") >= 0) layers.push_back({"Z", LayerKind::kFeature, "Z"});
  if (picture.find_channel("bias.Y") >= 0) layers.push_back({"bias", LayerKind::kFeature, "Y"});
  if (picture.find_channel(kSamples) >= 0) layers.push_back({kSamples, LayerKind::kFeature, "N"});
  return layers;
}

/// A number of samples from a file, which may hold anything.
uint64_t count_of(float value) {
  constexpr float kMaxCount = 1e18f;
  return value > 0 ? static_cast<uint64_t>(std::min(value, kMaxCount)) : 0;
}

}  // namespace

PictureSource::PictureSource(const std::string& path) : picture_(read_picture(path)) {
  color_picture(picture_);  // throws if it has no colours
  state_.name = path;
  state_.is_scene = false;
  state_.status = LiveStatus::kDone;
  state_.generation = state_.version = 1;
  state_.width = picture_.full_width;
  state_.height = picture_.full_height;
  state_.window = picture_.window;
  state_.layers = layers_of(picture_);
  state_.report = lines_of(value_of(picture_.metadata, kChoicesKey));
  state_.settings.integrator = value_of(picture_.metadata, kIntegratorKey);
  state_.settings.width = state_.width;
  state_.settings.height = state_.height;
  state_.why_mix_is_inexact = joined(inexact_mix_reasons(picture_.metadata));
}

uint64_t PictureSource::wait_for_news(uint64_t seen, double seconds) const {
  if (seen == 1) std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  return 1;
}

FrameLayerPtr PictureSource::layer(const std::string& name) {
  const auto found = std::ranges::find(state_.layers, name, &LiveLayer::name);
  if (found == state_.layers.end()) return nullptr;
  const std::lock_guard lock(mutex_);
  FrameLayerPtr& made = layers_[name];
  if (!made) made = frame_layer(picture_, name, found->channels, channels_of(*found));
  return made;
}

std::optional<std::string> PictureSource::frame(const std::vector<std::string>& names,
                                                uint64_t generation, uint64_t since) {
  if (generation == 1 && since == 1) return std::nullopt;
  std::vector<FrameLayerPtr> layers;
  for (const std::string& name : names)
    if (FrameLayerPtr made = layer(name)) layers.push_back(std::move(made));
  return encode_frame(info(), layers, 0);
}

std::optional<PictureFrame> PictureSource::picture() {
  return PictureFrame{info(), layer(kPictureLayer)};
}

FrameInfo PictureSource::info() const {
  FrameInfo info;
  info.generation = info.version = 1;
  info.width = picture_.full_width;
  info.height = picture_.full_height;
  info.window = picture_.window;
  return info;
}

float PictureSource::value(size_t pixel, const std::string& channel) const {
  const int index = picture_.find_channel(channel);
  return index < 0 ? 0
                   : picture_.pixels[pixel * picture_.channels.size() + static_cast<size_t>(index)];
}

ProbedPixel PictureSource::probe(int x, int y) {
  check_pixel(x, y, picture_.window);
  const size_t pixel = static_cast<size_t>(y - picture_.window.y0) * picture_.width() +
                       static_cast<size_t>(x - picture_.window.x0);
  ProbedPixel probed;
  probed.value = {value(pixel, "R"), value(pixel, "G"), value(pixel, "B")};
  probed.standard_error = {value(pixel, "stderr.R"), value(pixel, "stderr.G"),
                           value(pixel, "stderr.B")};
  probed.samples = count_of(value(pixel, "samples"));
  return probed;
}

Picture PictureSource::colors(const LayerGains& gains) {
  return mixed_colors(picture_, gains);
}

void PictureSource::write(const std::string& exr_path) {
  write_picture(exr_path, picture_, 1, exact_precision(picture_));
}

}  // namespace nephroid
