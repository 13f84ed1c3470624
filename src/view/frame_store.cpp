#include "view/frame_store.h"

namespace nephroid {
namespace {

/// Layers that nobody has asked for so long are not made any more.
constexpr double kSecondsOfInterest = 10;

}  // namespace

std::vector<std::string> FrameStore::wanted(double now) {
  const std::lock_guard lock(mutex_);
  forget_old_wishes(now);
  wanted_.try_emplace(kPictureLayer, now);
  std::vector<std::string> names;
  for (const auto& entry : wanted_) names.push_back(entry.first);
  return names;
}

uint64_t FrameStore::update(const Film& film, FrameInfo info, double now) {
  std::map<std::string, FrameLayerPtr> before;
  {
    const std::lock_guard lock(mutex_);
    info.version = info_.version + 1;
    // Tiles of another view do not count as known.
    if (info.generation == info_.generation && film.bounds() == info_.window) before = layers_;
  }
  info.width = film.settings().width;
  info.height = film.settings().height;
  info.window = film.bounds();
  std::map<std::string, FrameLayerPtr> made;
  for (const FilmLayer& layer : film_layers(film, wanted(now))) {
    const auto old = before.find(layer.name);
    made[layer.name] =
        frame_layer(film, layer, info.version, old == before.end() ? nullptr : old->second.get());
  }
  const std::lock_guard lock(mutex_);
  info_ = info;
  layers_ = std::move(made);
  absent_.clear();
  return info_.version;
}

void FrameStore::add(const Film* film, uint64_t generation, const std::vector<std::string>& names) {
  std::vector<std::string> missing;
  uint64_t version = 0;
  {
    const std::lock_guard lock(mutex_);
    version = info_.version;
    for (const std::string& name : names)
      if (!layers_.contains(name) && absent_.insert(name).second) missing.push_back(name);
    if (film == nullptr || generation != info_.generation) return;
  }
  for (const FilmLayer& layer : film_layers(*film, missing)) {
    FrameLayerPtr made = frame_layer(*film, layer, version, nullptr);
    const std::lock_guard lock(mutex_);
    layers_[layer.name] = std::move(made);
  }
}

bool FrameStore::want(const std::vector<std::string>& layers, double now) {
  const std::lock_guard lock(mutex_);
  forget_old_wishes(now);
  bool has_all = true;
  for (const std::string& name : layers) {
    wanted_[name] = now;
    has_all = has_all && (layers_.contains(name) || absent_.contains(name));
  }
  return has_all;
}

void FrameStore::forget_old_wishes(double now) {
  std::erase_if(wanted_, [now](const auto& entry) {
    return entry.first != kPictureLayer && now - entry.second > kSecondsOfInterest;
  });
}

std::optional<std::string> FrameStore::frame(const std::vector<std::string>& names,
                                             uint64_t generation, uint64_t since) const {
  FrameInfo info;
  std::vector<FrameLayerPtr> layers;
  {
    const std::lock_guard lock(mutex_);
    if (info_.version == 0) return std::nullopt;
    info = info_;
    for (const std::string& name : names)
      if (const auto found = layers_.find(name); found != layers_.end())
        layers.push_back(found->second);
  }
  const bool knows = generation == info.generation && since <= info.version;
  if (knows && since == info.version) return std::nullopt;
  return encode_frame(info, layers, knows ? since : 0);
}

std::optional<PictureFrame> FrameStore::picture() const {
  const std::lock_guard lock(mutex_);
  const auto found = layers_.find(kPictureLayer);
  if (found == layers_.end()) return std::nullopt;
  return PictureFrame{info_, found->second};
}

uint64_t FrameStore::version() const {
  const std::lock_guard lock(mutex_);
  return info_.version;
}

}  // namespace nephroid
