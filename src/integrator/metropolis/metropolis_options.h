// Options of Metropolis light transport.
#pragma once

#include "integrator/estimator/estimator_descriptor.h"

namespace nephroid {

struct MetropolisOptions {
  float mutations = 0;       ///< mutations per pixel and pass; 0: the default
  int64_t chain_length = 0;  ///< mutations per chain; 0: the default
  float large_step = 0.1f;   ///< probability of a large step
};

extern const EstimatorSetting kMutationsSetting, kChainLengthSetting, kLargeStepSetting;
inline constexpr const EstimatorSetting* kMetropolisSettings[] = {
    &kMutationsSetting, &kChainLengthSetting, &kLargeStepSetting};

}  // namespace nephroid
