// Common parts of the Metropolis estimators: the size of a pass, the pilot that balances chains
// and independent paths, and the report. It must not know how paths are made.
#pragma once

#include "integrator/estimator/estimator.h"
#include "integrator/metropolis/markov_chain.h"
#include "integrator/metropolis/metropolis_options.h"

namespace nephroid {

/// The pilot of a scene as an estimator's learned value.
class LearnedPilot final : public Learned {
 public:
  explicit LearnedPilot(ChainPilot pilot) : pilot_(std::move(pilot)) {}
  /// Runs the pilot with functions of `make`.
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

  /// Adds a pass of a group's light to the film. `make` makes the function that chains explore.
  void render(const PassKey& key, const Scene& scene, int group, const ChainPilot& pilot,
              const PathFunctionMaker& make, Film& film, PassControl& control);
  EstimatorStatistics statistics() const;

 private:
  ChainSettings settings_for(int64_t pixels) const;

  MetropolisOptions options_;
  ChainStatistics counts_;
  uint64_t pixel_bytes_ = 0;  ///< memory of the sums of a pass
};

}  // namespace nephroid
