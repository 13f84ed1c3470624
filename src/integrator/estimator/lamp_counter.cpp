#include "integrator/estimator/lamp_counter.h"

#include <cmath>

namespace nephroid {

namespace {

/// As in TechniqueCounter: later passes are not slowed down.
constexpr uint32_t kPassesOfLamps = 8;

}  // namespace

LampCounter::LampCounter(const SceneSymbols& symbols, uint32_t pass, bool counts)
    : symbols_(symbols), counts_(counts && pass < kPassesOfLamps) {
  if (counts_) lamps_.resize(symbols.lamp_names().size());
}

LampCounter::Slice::Slice(LampCounter* counter, PartSums& light)
    : counter_(counter && counter->counts() ? counter : nullptr), light_(light) {
  if (!counter_) return;
  light_.tell_lamps_apart(counter_->lamps_.size());
  found_.resize(counter_->lamps_.size());
}

LampCounter::Slice::~Slice() {
  if (counter_) counter_->add(found_, light_.lamp_rays());
}

void LampCounter::Slice::take(const SensorWeights& weights, double factor) {
  if (counter_) light_.add_lamps_to(found_, weights, factor);
}

void LampCounter::add(const std::vector<double>& found, std::span<const uint32_t> rays) {
  const std::lock_guard lock(mutex_);
  for (size_t i = 0; i < lamps_.size(); ++i) {
    if (found[i] != 0) lamps_[i].light.add(found[i]);
    lamps_[i].rays += rays[i];
  }
}

void LampCounter::add_splats(std::span<const Splat> splats, const FilmFormat& film, double share) {
  if (!counts()) return;
  const PixelBounds& b = film.bounds();
  const auto within = [](float x, int begin, int end) {
    return x >= static_cast<float>(begin) && x < static_cast<float>(end);
  };
  for (const Splat& splat : splats)
    if (within(splat.film.x, b.x0, b.x1) && within(splat.film.y, b.y0, b.y1))
      lamps_[splat.lamp].light.add(
          share * (static_cast<double>(splat.value.r) + splat.value.g + splat.value.b));
}

void LampCounter::add_to(EstimatorStatistics& statistics) const {
  if (!counts()) return;
  ++statistics.lamp_passes;
  if (statistics.lamps.empty())
    for (const std::string& name : symbols_.lamp_names()) statistics.lamps.push_back({name});
  for (size_t i = 0; i < lamps_.size(); ++i) {
    statistics.lamps[i].light += lamps_[i].light.value();
    statistics.lamps[i].rays += lamps_[i].rays;
  }
}

}  // namespace nephroid
