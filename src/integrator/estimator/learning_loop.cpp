#include "integrator/estimator/learning_loop.h"

#include <utility>

namespace nephroid {

void LearningLoop::start(const Estimator& estimator, uint64_t seed, const Scene& scene,
                         const FilmFormat& format, PassControl& control) {
  if (for_all_seeds_ || seed_ == seed) return;
  values_ = {estimator.learn(scene, format, seed, control), nullptr};
  has_learned_from_first_ = false;
  found_.reset();
  seed_ = seed;
}

void LearningLoop::render_pass(Estimator& estimator, const PassKey& key, const Scene& scene,
                               Film& film, PassControl& control) {
  start(estimator, key.seed, scene, film.format(), control);
  if (key.pass > 0) {
    learn(estimator, key.seed, scene, film.format(), control);
    estimator.render_pass(key, values_.after_first_pass.get(), scene, film, control);
    return;
  }
  std::unique_ptr<PassFindings> found =
      estimator.render_pass(key, values_.before_passes.get(), scene, film, control);
  // It is learned from when another pass asks for it.
  if (!has_learned_from_first_) found_ = std::move(found);
}

const LearnedValues& LearningLoop::learn(const Estimator& estimator, uint64_t seed,
                                         const Scene& scene, const FilmFormat& format,
                                         PassControl& control) {
  start(estimator, seed, scene, format, control);
  if (has_learned_from_first_) return values_;
  values_.after_first_pass = estimator.learn_from_first_pass(
      values_.before_passes, std::move(found_), scene, format, seed, control);
  has_learned_from_first_ = true;
  return values_;
}

void LearningLoop::use(const LearnedValues& values) {
  values_ = values;
  for_all_seeds_ = has_learned_from_first_ = true;
}

void LearningLoop::add_to(EstimatorStatistics& statistics) const {
  const auto& learned = values_.after_first_pass ? values_.after_first_pass : values_.before_passes;
  if (learned) learned->add_to(statistics);
}

}  // namespace nephroid
