// A plan of routes and a scene -> the estimators that render them and the layout of their film.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrator/estimator/learning_loop.h"
#include "integrator/presets/estimator_table.h"
#include "route/plan.h"

namespace nephroid {

/// Estimators and the film that they fill; estimator i samples the film's group i (one more, if
/// there is one, its features).
struct EstimatorSet {
  FilmLayout layout;
  std::vector<std::unique_ptr<Estimator>> estimators;
  std::vector<LearningLoop> learned;  ///< by the estimator of the same number
  std::shared_ptr<const Routes> routes;
  std::vector<std::string> warnings;  ///< about the routes: overlaps, paths that are never found
  std::vector<std::string> notes;     ///< why routes are black that no photon could find

  /// Adds a pass of all estimators to the film; what they have to learn for it is learned first.
  /// `control` may end it with PassStopped; the same pass then goes on where it ended.
  void render_pass(const PassKey& key, const Scene& scene, Film& film,
                   PassControl& control = unwatched);
  /// Of each estimator, learning included.
  std::vector<EstimatorStatistics> statistics() const;
};

/// Estimators for the routes of a plan in a scene. Throws UsageError for an expression that is
/// wrong, for routes that leave a path out, and for what an estimator cannot do in this scene. The
/// routes are of estimators of the table.
EstimatorSet make_estimators(const RoutePlan& plan, const IntegratorOptions& options,
                             const Scene& scene, EstimatorTable table = estimator_table());
/// The same of a plan that is compiled already; the warnings leave out what the proof found.
EstimatorSet make_estimators(CompiledPlan compiled, const IntegratorOptions& options,
                             const Scene& scene, EstimatorTable table = estimator_table());

}  // namespace nephroid
