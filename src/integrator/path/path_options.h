// Options of camera walks.
#pragma once

#include "integrator/estimator/estimator_descriptor.h"

namespace nephroid {

struct PathOptions {
  bool specular_trees = false;  ///< camera walks grow specular trees ([S1])
  /// Walks of `path` ignore which events are useful to its routes: the same seed gives the same
  /// paths for all routes.
  bool blind_walks = false;
};

/// -D specular-trees.
extern const EstimatorSetting kSpecularTreesSetting;

}  // namespace nephroid
