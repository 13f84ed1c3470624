// What the Metropolis estimators share: how large a pass is, the pilot that says how chains and
// independent paths are balanced, the film that paths are spread over, and the report.
// It must not know how paths are made.
#pragma once

#include "integrator/estimator/estimator.h"
#include "integrator/metropolis/markov_chain.h"
#include "integrator/metropolis/metropolis_options.h"

namespace nephroid {

/// What a few paths tell of a scene before the first pass.
class LearnedPilot final : public Learned {
 public:
  explicit LearnedPilot(ChainPilot pilot) : pilot_(std::move(pilot)) {}
  /// Traces them with `make`.
  static std::shared_ptr<const LearnedPilot> learn(uint64_t seed, const FilmArea& area,
                                                   size_t kinds, const PathFunctionMaker& make,
                                                   PassControl& control);
  /// Reads a value learned for `kinds` kinds of paths. Throws IoError if it is damaged.
  static std::shared_ptr<const LearnedPilot> read(ByteReader& from, size_t kinds);
  const ChainPilot& pilot() const { return pilot_; }
  void write(ByteWriter& to) const override { to(pilot_); }
  void add_to(EstimatorStatistics&) const override {}

 private:
  ChainPilot pilot_;
};

class MetropolisPasses {
 public:
  explicit MetropolisPasses(const MetropolisOptions& options) : options_(options) {}

  /// Adds a pass of a group's light to the film. `make` makes what chains explore.
  void render(const PassKey& key, const Scene& scene, int group, const ChainPilot& pilot,
              const PathFunctionMaker& make, Film& film, PassControl& control);
  EstimatorStatistics statistics() const;

 private:
  ChainSettings settings_for(int64_t pixels) const;

  MetropolisOptions options_;
  ChainStatistics counts_;
  uint64_t pixel_bytes_ = 0;  ///< of the sums of a pass
};

}  // namespace nephroid
