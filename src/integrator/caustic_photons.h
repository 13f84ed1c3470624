// The photon half of `mixed`: stochastic progressive photon mapping with the memoryless radius
// [E2], storing only the photons of its own route. A pass is a function of the scene, the options
// and the pass key alone, so passes may be rendered anywhere and added up. Papers: Hachisuka &
// Jensen 2009; Knaus & Zwicker 2011; Doidge et al. 2012.
#pragma once

#include "integrator/estimator.h"
#include "route/routes.h"

namespace nephroid {

class CausticPhotons : public Estimator {
 public:
  /// Renders the part of `route` that merges at a D vertex into the film's buffer `buffer`.
  CausticPhotons(const Routes& routes, Route route, int buffer, const IntegratorOptions& options);

  Capabilities capabilities() const override { return {}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override;

 private:
  Routes routes_;
  Route route_;
  int buffer_;
  IntegratorOptions options_;
  bool has_specular_material_ = true;
  uint64_t found_ = 0;  ///< photons merged
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
