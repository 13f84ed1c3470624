// Options of guiding for photons and camera walks.
#pragma once

#include "integrator/estimator/estimator_descriptor.h"

namespace nephroid {

struct GuidingOptions {
  bool photons = true;  ///< guide photons to where earlier ones were useful
  bool walks = true;    ///< guide camera walks to where earlier ones found light
};

/// -D guide and -D guide-walks.
extern const EstimatorSetting kGuideSetting, kGuideWalksSetting;

}  // namespace nephroid
