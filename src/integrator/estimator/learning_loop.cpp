#include "integrator/estimator/learning_loop.h"

#include <utility>

namespace nephroid {

const std::shared_ptr<const Learned>& LearningLoop::learn(const Estimator& estimator, uint64_t seed,
                                                          const Scene& scene,
                                                          const FilmFormat& format,
                                                          PassControl& control) {
  if (for_all_seeds_ || seed_ == seed) return value_;
  value_ = estimator.learn(scene, format, seed, control);
  seed_ = seed;
  return value_;
}

void LearningLoop::render_pass(Estimator& estimator, const PassKey& key, const Scene& scene,
                               Film& film, PassControl& control) {
  const auto& learned = learn(estimator, key.seed, scene, film.format(), control);
  estimator.render_pass(key, learned.get(), scene, film, control);
}

void LearningLoop::use(std::shared_ptr<const Learned> value) {
  value_ = std::move(value);
  for_all_seeds_ = true;
}

void LearningLoop::add_to(EstimatorStatistics& statistics) const {
  if (value_) value_->add_to(statistics);
}

}  // namespace nephroid
