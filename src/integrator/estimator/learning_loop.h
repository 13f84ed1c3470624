// Passes of one estimator in any order, with learning where it is due. It must not know what is
// learned.
#pragma once

#include <optional>

#include "integrator/estimator/estimator.h"

namespace nephroid {

/// Keeps what an estimator has learned for the seed of the last pass.
class LearningLoop {
 public:
  /// Renders a pass after learning what it needs and has not been learned yet.
  void render_pass(Estimator& estimator, const PassKey& key, const Scene& scene, Film& film,
                   PassControl& control = unwatched);
  /// Both values for a seed, whichever passes have been rendered.
  const LearnedValues& learn(const Estimator& estimator, uint64_t seed, const Scene& scene,
                             const FilmFormat& format, PassControl& control = unwatched);
  /// From now on passes of all seeds use these values, learned of the same scene, format and
  /// options.
  void use(const LearnedValues& values);
  /// Adds the costs and findings of what is learned by now.
  void add_to(EstimatorStatistics& statistics) const;

 private:
  void start(const Estimator& estimator, uint64_t seed, const Scene& scene,
             const FilmFormat& format, PassControl& control);

  LearnedValues values_;
  std::unique_ptr<PassFindings> found_;  ///< by pass 0, until it is learned from
  std::optional<uint64_t> seed_;         ///< empty: nothing is learned
  bool for_all_seeds_ = false;           ///< values were handed in
  bool has_learned_from_first_ = false;
};

}  // namespace nephroid
