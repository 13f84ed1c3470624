// `direct`: light that comes straight from a lamp, or by way of one surface.
#pragma once

#include "integrator/estimator/estimator.h"

namespace nephroid {

class DirectLighting final : public Estimator {
 public:
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }

  DirectLighting(OwnedRoutes owned, const IntegratorOptions& options)
      : owned_(std::move(owned)), options_(options) {}
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
