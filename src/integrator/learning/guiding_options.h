// Whether photons and camera walks learn where to go.
#pragma once

#include "integrator/estimator/estimator_descriptor.h"

namespace nephroid {

struct GuidingOptions {
  bool photons = true;  ///< photons start and go where earlier ones were of use
  bool walks = true;    ///< camera walks go where earlier ones found light
};

/// -D guide and -D guide-walks.
extern const EstimatorSetting kGuideSetting, kGuideWalksSetting;

}  // namespace nephroid
