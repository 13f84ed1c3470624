// One estimate of a pixel: spectra by part of an estimator's routes, before they become colours. A
// path finds light of few parts, and only those take time. It must not know walks or scenes.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "core/color.h"
#include "film/film.h"
#include "film/lamp_light.h"
#include "film/technique_light.h"
#include "route/routes.h"

namespace nephroid {

class PartSums {
 public:
  PartSums(const Routes& routes, size_t group)
      : sums_(routes.groups()[group].parts.size()), is_found_(sums_.size()), colors_(sums_.size()) {
    place_.fill(kNotOwned);
    for (size_t i = 0; i < sums_.size(); ++i)
      place_[routes.groups()[group].parts[i]] = static_cast<uint8_t>(i);
  }

  /// True if the group owns this part; false for kNoPart.
  bool owns(Part part) const { return place_[part] != kNotOwned; }
  /// Index of an owned part within its group, as in Film::add.
  size_t place(Part part) const { return place_[part]; }
  void add(Part part, const SampledSpectrum& value) {
    assert(of_techniques_.empty());
    sums_[place_with_light(part)] += value;
  }
  void add(Part part, const SampledSpectrum& value, Technique technique) {
    const size_t i = place_with_light(part);
    sums_[i] += value;
    if (!of_techniques_.empty()) of_techniques_[i][static_cast<size_t>(technique)] += value;
  }
  /// Turns on sums per technique.
  void tell_techniques_apart() { of_techniques_.resize(sums_.size()); }
  /// Adds each technique's light to `light`, by part, as the sum of a colour's components times
  /// `factor`. Values that are not finite are left out, as in the film.
  void add_techniques_to(std::span<TechniqueLight> light, const SensorWeights& weights,
                         double factor) const {
    if (of_techniques_.empty()) return;
    for (const size_t i : found_)
      for (size_t t = 0; t < kTechniqueCount; ++t) {
        const Rgb color = weights.apply(of_techniques_[i][t]);
        const double found = factor * (static_cast<double>(color.r) + color.g + color.b);
        if (std::isfinite(found)) light[i][t] += found;
      }
  }
  /// Turns on sums per lamp, for this number of lamps.
  void tell_lamps_apart(size_t lamps) { lamp_rays_.assign(lamps, 0); }
  void add(Part part, Lamp lamp, const SampledSpectrum& value) {
    add(part, value);
    add_of_lamp(lamp, value);
  }
  void add(Part part, Lamp lamp, const SampledSpectrum& value, Technique technique) {
    add(part, value, technique);
    add_of_lamp(lamp, value);
  }
  /// Counts a shadow ray to a lamp.
  void count_ray_to(Lamp lamp) {
    if (!lamp_rays_.empty()) ++lamp_rays_[lamp];
  }
  /// [lamp]: shadow rays; empty unless sums per lamp are on.
  std::span<const uint32_t> lamp_rays() const { return lamp_rays_; }
  /// As add_techniques_to, with `light` by lamp.
  void add_lamps_to(std::span<double> light, const SensorWeights& weights, double factor) const {
    for (const OfLamp& l : of_lamps_) {
      const Rgb color = weights.apply(l.value);
      const double found = factor * (static_cast<double>(color.r) + color.g + color.b);
      if (std::isfinite(found)) light[l.lamp] += found;
    }
  }
  /// Turns on the sum of squares of merged photons. `weights` must outlive it.
  void measure_photons(const SensorWeights& weights) { photon_weights_ = &weights; }
  /// Adds to the estimated bias [E4] of all parts together, and to that sum, the `value` of one
  /// merged photon, which a part has already.
  void add_merged(const SampledSpectrum& value, const SampledSpectrum& bias) {
    bias_ += bias;
    if (photon_weights_ == nullptr) return;
    const Rgb color = photon_weights_->apply(value);
    photon_squares_ += sqr((double{color.r} + color.g + color.b) / 3);
  }
  /// The sum, of means of a colour's components, since the last clear().
  double photon_squares() const { return photon_squares_; }
  void clear() {
    for (const size_t i : found_) {
      sums_[i] = SampledSpectrum();
      if (!of_techniques_.empty()) of_techniques_[i].fill(SampledSpectrum());
      is_found_[i] = 0;
    }
    found_.clear();
    of_lamps_.clear();
    bias_ = SampledSpectrum();
    photon_squares_ = 0;
  }
  std::span<const SampledSpectrum> sums() const { return sums_; }

  /// The bias as the mean of a colour's components.
  float bias(const SensorWeights& weights) const {
    const Rgb color = weights.apply(bias_);
    return (color.r + color.g + color.b) / 3.0f;
  }

  /// The sums as colours times `factor`, clamped together to `max_component`, then times
  /// `filter_weight`. Valid until the next call.
  std::span<const Rgb> colors(const SensorWeights& weights, float factor, float max_component,
                              float filter_weight) {
    for (const size_t i : colored_) colors_[i] = Rgb();
    colored_ = found_;
    for (const size_t i : found_) colors_[i] = weights.apply(sums_[i]) * factor;
    clamp_total(colors_, max_component);
    for (const size_t i : found_) colors_[i] = colors_[i] * filter_weight;
    return colors_;
  }

  /// Scales all colours by one factor, so that no component of their total exceeds `limit` in
  /// magnitude.
  static void clamp_total(std::span<Rgb> colors, float limit) {
    if (!(limit < kInfinity)) return;
    Rgb total;
    for (const Rgb& color : colors) total = total + color;
    const float largest = std::max({std::abs(total.r), std::abs(total.g), std::abs(total.b)});
    if (!(largest > limit)) return;
    for (Rgb& color : colors) color = color * (limit / largest);
  }

 private:
  /// The place of a part, noted as one with light.
  size_t place_with_light(Part part) {
    const uint8_t place = place_[part];
    if (is_found_[place] == 0) {
      is_found_[place] = 1;
      found_.push_back(place);
    }
    return place;
  }
  void add_of_lamp(Lamp lamp, const SampledSpectrum& value) {
    if (lamp_rays_.empty()) return;
    if (of_lamps_.empty() || of_lamps_.back().lamp != lamp) of_lamps_.push_back({lamp, {}});
    of_lamps_.back().value += value;
  }

  static constexpr uint8_t kNotOwned = 255;
  std::array<uint8_t, 256> place_;
  std::vector<SampledSpectrum> sums_;
  std::vector<uint8_t> is_found_;         ///< [place] 1: in found_
  std::vector<uint8_t> found_, colored_;  ///< places with light, and those of colors_ in use
  std::vector<std::array<SampledSpectrum, kTechniqueCount>> of_techniques_;  ///< empty: off
  struct OfLamp {
    Lamp lamp;
    SampledSpectrum value;
  };
  std::vector<OfLamp> of_lamps_;     ///< light per lamp since the last clear()
  std::vector<uint32_t> lamp_rays_;  ///< [lamp]; empty: off
  SampledSpectrum bias_;
  const SensorWeights* photon_weights_ = nullptr;  ///< null: photons are not measured
  double photon_squares_ = 0;
  std::vector<Rgb> colors_;
};

}  // namespace nephroid
