// `mlt`: Markov chains that choose one technique of bidirectional path tracing for each path, so
// that they stay with the techniques that are good where they are (Hachisuka, Kaplanyan &
// Dachsbacher 2014). A pass is a function of the scene, the options and the pass key, and unbiased
// by itself (docs/estimators.md, [Z7]). Who calls it: presets. It must not know how pairs of paths
// are connected or chains are run.
#pragma once

#include <optional>

#include "integrator/estimator.h"
#include "integrator/metropolis_pass.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// How often paths of each length, in scattering events, are tried.
class LengthChoice {
 public:
  struct Chosen {
    int length;
    float probability;
  };
  /// By a guess.
  explicit LengthChoice(int max_length);
  /// By how bright each length is; the guess keeps a share, so that no length is left out.
  explicit LengthChoice(std::span<const double> brightness);
  Chosen choose(float u) const;
  size_t lengths() const { return probability_.size(); }

 private:
  std::vector<double> probability_, cdf_;
  void add_up();
};

class Multiplexed : public Estimator {
 public:
  Multiplexed(OwnedRoutes owned, const IntegratorOptions& options);

  Capabilities capabilities() const override { return {}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override { return passes_.statistics(); }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  MetropolisPasses passes_;
};

}  // namespace nephroid
