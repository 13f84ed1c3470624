// Passes of one estimator in any order, with learning where it is due. It must not know what is
// learned.
#pragma once

#include <optional>
#include <string>

#include "film/render_state.h"
#include "integrator/estimator/estimator.h"

namespace nephroid {

/// Keeps what an estimator has learned for the seed of the last pass.
class LearningLoop {
 public:
  /// Renders a pass after learning what it needs and has not been learned yet.
  void render_pass(Estimator& estimator, const PassKey& key, const Scene& scene, Film& film,
                   PassControl& control = unwatched);
  /// The value for a seed.
  const std::shared_ptr<const Learned>& learn(const Estimator& estimator, uint64_t seed,
                                              const Scene& scene, const FilmFormat& format,
                                              PassControl& control = unwatched);
  /// From now on passes of all seeds use this value, learned of the same scene, format and options.
  void use(std::shared_ptr<const Learned> value);
  /// Adds what is learned by now to a state, under the name, or reads it from there.
  void add_state(const Estimator& estimator, const FilmFormat& format, std::string name,
                 RenderState& state);
  /// Adds the findings of what is learned by now, and its costs, without rays if it was read.
  void add_to(EstimatorStatistics& statistics) const;

 private:
  std::shared_ptr<const Learned> value_;
  std::optional<uint64_t> seed_;  ///< empty: nothing is learned
  bool for_all_seeds_ = false;    ///< the value was handed in
  bool was_read_ = false;
};

}  // namespace nephroid
