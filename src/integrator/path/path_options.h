// Options of walks from the eye.
#pragma once

#include "integrator/estimator/estimator_descriptor.h"

namespace nephroid {

struct PathOptions {
  bool specular_trees = false;  ///< walks of one way each look for lights both ways
  /// Walks of `path` do not look at what is useful for its routes: the same seed gives the same
  /// paths whatever the routes are.
  bool blind_walks = false;
};

/// -D specular-trees.
extern const EstimatorSetting kSpecularTreesSetting;

}  // namespace nephroid
