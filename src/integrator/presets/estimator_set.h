// Makes the estimators of a plan of routes in a scene, and the layout of their film.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrator/estimator/learning_loop.h"
#include "integrator/presets/estimator_table.h"
#include "route/plan.h"

namespace nephroid {

/// Estimators and the film that they fill. Estimator i samples the film's group i; one more, if
/// there is one, records features.
struct EstimatorSet {
  FilmLayout layout;
  std::vector<std::unique_ptr<Estimator>> estimators;
  std::vector<LearningLoop> learned;  ///< [estimator]
  std::shared_ptr<const Routes> routes;
  std::vector<std::string> warnings;  ///< warnings about routes: overlaps, paths never found
  std::vector<std::string> notes;     ///< routes that are black because no path belongs to them

  /// Adds a pass of all estimators to the film; they learn first if needed. `control` may stop it
  /// with PassStopped; a second call continues the same pass.
  void render_pass(const PassKey& key, const Scene& scene, Film& film,
                   PassControl& control = unwatched);
  /// Statistics of each estimator, learning included.
  std::vector<EstimatorStatistics> statistics() const;
};

/// Makes the estimators for the routes of a plan in a scene. Throws UsageError for an invalid
/// expression, routes that leave a path out, or an estimator that cannot work in this scene. The
/// routes must name estimators of the table.
EstimatorSet make_estimators(const RoutePlan& plan, const IntegratorOptions& options,
                             const Scene& scene, EstimatorTable table = estimator_table());
/// The same for a compiled plan; the warnings do not repeat the findings of the proof.
EstimatorSet make_estimators(CompiledPlan compiled, const IntegratorOptions& options,
                             const Scene& scene, EstimatorTable table = estimator_table());

}  // namespace nephroid
