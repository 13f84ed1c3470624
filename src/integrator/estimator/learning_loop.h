// Renders passes of one estimator in any order and learns when needed. It must not know what is
// learned.
#pragma once

#include <optional>
#include <string>

#include "film/render_state.h"
#include "integrator/estimator/estimator.h"

namespace nephroid {

/// Keeps the value that an estimator learned for the seed of the last pass.
class LearningLoop {
 public:
  /// Renders a pass; learns its value first if needed.
  void render_pass(Estimator& estimator, const PassKey& key, const Scene& scene, Film& film,
                   PassControl& control = unwatched);
  /// The learned value for a seed.
  const std::shared_ptr<const Learned>& learn(const Estimator& estimator, uint64_t seed,
                                              const Scene& scene, const FilmFormat& format,
                                              PassControl& control = unwatched);
  /// Makes passes of all seeds use this value, learned from the same scene, format and options.
  void use(std::shared_ptr<const Learned> value);
  /// Saves the present value in a state under `name`, or reads it from there.
  void add_state(const Estimator& estimator, const FilmFormat& format, std::string name,
                 RenderState& state);
  /// Adds the findings and costs of the present value, without rays if it was read.
  void add_to(EstimatorStatistics& statistics) const;

 private:
  std::shared_ptr<const Learned> value_;
  std::optional<uint64_t> seed_;  ///< empty: nothing learned
  bool for_all_seeds_ = false;    ///< the value came from use()
  bool was_read_ = false;
  bool read_nothing_ = false;  ///< a state said that there is nothing to learn
};

}  // namespace nephroid
