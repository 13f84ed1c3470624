// `forecast`: path tracing guided by photons towards the casters of caustics. Photons are traced
// once, before the first pass. At rough vertices a walk samples a mixture of its BSDF and
// directions to the casters of nearby photons ([T3] in docs/estimators.md), without bias.
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
