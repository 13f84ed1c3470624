// What the Metropolis estimators share: how large a pass is, the pilot that says how chains and
// independent paths are balanced, the film that paths are spread over, and the report.
// Who calls it: primary_space.cpp and multiplexed.cpp. It must not know how paths are made.
#pragma once

#include <optional>

#include "integrator/estimator/estimator.h"
#include "integrator/metropolis/markov_chain.h"

namespace nephroid {

class MetropolisPasses {
 public:
  explicit MetropolisPasses(const IntegratorOptions& options) : options_(options) {}

  /// What a few paths tell, found out with `make` once for each seed.
  const ChainPilot& pilot(uint64_t seed, const FilmArea& area, size_t kinds,
                          const PathFunctionMaker& make);
  /// Adds a pass of a group's light to the film. `make` makes what chains explore. The pilot of the
  /// pass's seed has been asked for.
  void render(const PassKey& key, const Scene& scene, int group, const PathFunctionMaker& make,
              Film& film);
  EstimatorStatistics statistics() const;

 private:
  ChainSettings settings_for(int64_t pixels) const;

  IntegratorOptions options_;
  ChainStatistics counts_;
  uint64_t pixel_bytes_ = 0;  ///< of the sums of a pass
  uint64_t pilot_seed_ = 0;
  std::optional<ChainPilot> pilot_;
};

}  // namespace nephroid
