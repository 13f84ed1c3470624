// `forecast`: path tracing that knows where caustics come from. Photons are traced once, before
// the first pass; at each rough vertex a walk chooses between its BSDF and directions towards the
// casters that photons near by came from, by a mixture whose density is known ([T3] in
// docs/estimators.md), so it finds the same light as path tracing, with no bias. What is learned
// is a function of the scene, the options and the seed, a pass of these and its number.
// Paper: Budge, Anderson & Joy 2008.
#pragma once

#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

class Forecast : public Estimator {
 public:
  Forecast(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override;

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
