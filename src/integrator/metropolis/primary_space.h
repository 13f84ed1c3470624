// `pssmlt`: path tracing whose random numbers are explored by Markov chains, so that bright paths
// which are hard to find lead to similar ones (docs/estimators.md, section 15). Passes are
// independent and unbiased. It must not know how chains are run. Paper: Kelemen et al. 2002.
#pragma once

#include "integrator/estimator/estimator.h"
#include "integrator/metropolis/metropolis_pass.h"
#include "route/scene_symbols.h"

namespace nephroid {

class PrimarySpace : public Estimator {
 public:
  PrimarySpace(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return passes_.statistics(); }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  MetropolisPasses passes_;
};

}  // namespace nephroid
