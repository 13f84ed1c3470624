#include "integrator/estimator/path_tally.h"

#include <algorithm>
#include <cmath>

#include "core/sampler.h"

namespace nephroid {

ColorSum WordTally::total() const {
  ColorSum sum;
  for (const ColorSum& of_technique : light) sum += of_technique;
  return sum;
}

void WordTally::add(const WordTally& other) {
  for (size_t t = 0; t < kTechniqueCount; ++t) light[t] += other.light[t];
  if (!(other.brightest > brightest)) return;
  brightest = other.brightest;
  points = other.points;
}

size_t PathTally::HashWord::operator()(const std::vector<Letter>& key) const {
  uint64_t hash = key.size();
  for (const Letter letter : key) hash = hash_combine(hash, letter);
  return hash;
}

void PathTally::start(bool with_last_vertex) {
  const int events = static_cast<int>(walk.events.size());
  word_.clear();
  for (const WalkEvent& event : walk.events) word_.push_back(letters_.of(event));
  points_.assign(1, walk.start);
  for (const WalkRecord::Vertex& v : walk.vertices)
    if (v.events < events || with_last_vertex) points_.push_back(v.p);
}

void PathTally::meet(const PathLight& found, const PathEnd& end) {
  start(false);
  take(found, end);
}

void PathTally::join(const PathLight& found, const WalkEvent& last, const PathEnd& end) {
  start(true);
  word_.push_back(letters_.of(last));
  take(found, end);
}

void PathTally::merge(const PathLight& found, const WalkEvent& last, const Photon& photon) {
  start(true);
  word_.push_back(letters_.of(last));
  const LightPathRecord& light = photons_->of(photon);
  const int events = photon.events;
  for (int i = events; i-- > 0;) word_.push_back(letters_.of(light.walk.events[i]));
  for (size_t i = light.walk.vertices.size(); i-- > 0;)
    if (light.walk.vertices[i].events < events) points_.push_back(light.walk.vertices[i].p);
  take(found, {light.light, -1, light.walk.start});
}

size_t PathTally::number_of(int route) {
  word_.push_back(static_cast<Letter>(route));
  const auto [known, is_new] = numbers_.emplace(word_, words_.size());
  word_.pop_back();
  if (is_new) {
    words_.emplace_back();
    words_.back().word = word_;
    words_.back().route = route;
  }
  return known->second;
}

void PathTally::take(const PathLight& found, const PathEnd& end) {
  word_.push_back(letters_.of(end));
  const size_t number = number_of(routes_.parts()[found.part].route);
  found_.push_back({number, found.technique, found.value});
  WordTally& word = words_[number];
  const float brightness = found.value.average();
  if (!(brightness > word.brightest)) return;
  word.brightest = brightness;
  word.points = points_;
  if (end.has_place) word.points.push_back(end.p);
}

void PathTally::end(const SensorWeights& weights, float factor, float max_component,
                    float filter_weight) {
  std::vector<Rgb> colors;
  Rgb total;
  for (const Found& found : found_) {
    colors.push_back(weights.apply(found.value) * factor);
    total = total + colors.back();
  }
  // As in films, a path with a value that is not finite is left out.
  if (total.is_finite()) {
    const float largest = std::max({std::abs(total.r), std::abs(total.g), std::abs(total.b)});
    const float scale = largest > max_component ? max_component / largest : 1.0f;
    for (size_t i = 0; i < found_.size(); ++i) {
      const Rgb color = colors[i] * (scale * filter_weight);
      words_[found_[i].word].light[static_cast<size_t>(found_[i].technique)] +=
          ColorSum{color.r, color.g, color.b};
    }
  }
  found_.clear();
}

const WordTally* PathTally::find(const WordTally& other) const {
  std::vector<Letter> key = other.word;
  key.push_back(static_cast<Letter>(other.route));
  const auto known = numbers_.find(key);
  return known != numbers_.end() ? &words_[known->second] : nullptr;
}

void PathTally::add(const PathTally& other) {
  for (const WordTally& word : other.words_) {
    word_ = word.word;
    words_[number_of(word.route)].add(word);
  }
}

}  // namespace nephroid
