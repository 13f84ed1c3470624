// `forecast`: path tracing that knows where caustics come from. Photons are traced once, before
// the first pass; at each rough vertex a walk chooses between its BSDF and directions towards the
// casters that photons near by came from, by a mixture whose density is known ([T3] in
// docs/estimators.md), so it finds the same light as path tracing, with no bias. What is learned
// is a function of the scene, the options and the seed, a pass of these and its number.
// Who calls it: presets. Paper: Budge, Anderson & Joy 2008.
#pragma once

#include <optional>
#include <vector>

#include "integrator/estimator/estimator.h"
#include "photon/forecast_map.h"
#include "route/scene_symbols.h"

namespace nephroid {

class Forecast : public Estimator {
 public:
  Forecast(OwnedRoutes owned, const IntegratorOptions& options);

  Capabilities capabilities() const override { return {}; }
  void render_pass(const PassKey& key, const Scene& scene, Film& film) override;
  EstimatorStatistics statistics() const override;

 private:
  void learn(uint64_t seed, const Scene& scene);
  void trace_photons(const PassKey& key, int64_t photons, const Scene& scene,
                     std::vector<CausticSight>& sights);

  OwnedRoutes owned_;
  IntegratorOptions options_;
  std::optional<uint64_t> learned_from_;  ///< the seed
  ForecastMap map_;
  uint64_t paths_of_map_ = 0;  ///< photon paths that left its sights
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
