// What the Metropolis estimators share: how large a pass is, the pilot that says how chains and
// independent paths are balanced, the film that paths are spread over, and the report.
// Who calls it: primary_space.cpp and multiplexed.cpp. It must not know how paths are made.
#pragma once

#include <optional>

#include "integrator/estimator.h"
#include "integrator/markov_chain.h"

namespace nephroid {

/// The places from which something of the crop can be seen: the crop, and around it the filter's
/// radius.
class FilmArea {
 public:
  FilmArea(const PixelBounds& crop, const PixelFilter& filter);
  /// Evenly distributed over the area.
  Vec2f place(const Vec2f& u) const { return low_ + Vec2f(u.x * size_.x, u.y * size_.y); }
  /// In pixels.
  float area() const { return size_.x * size_.y; }

 private:
  Vec2f low_, size_;
};

class MetropolisPasses {
 public:
  explicit MetropolisPasses(const IntegratorOptions& options) : options_(options) {}

  /// Adds a pass of a group's light to the film. `make` makes what chains explore; the pilot uses
  /// it too, once for each seed.
  void render(const PassKey& key, const Scene& scene, int group, const PathFunctionMaker& make,
              Film& film);
  EstimatorStatistics statistics() const;

 private:
  ChainSettings settings_for(int64_t pixels) const;

  IntegratorOptions options_;
  ChainStatistics counts_;
  struct Pilot {
    uint64_t seed = 0;
    double brightness = 0;
  };
  std::optional<Pilot> pilot_;
};

}  // namespace nephroid
