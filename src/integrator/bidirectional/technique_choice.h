// Which techniques of a bidirectional estimator are made: all, or one alone.
#pragma once

#include "integrator/estimator/estimator_descriptor.h"

namespace nephroid {

struct TechniqueChoice {
  int s = -1, t = -1;    ///< vertices of the light and of the eye side; -1: any number
  bool connects = true;  ///< false: merges alone
  bool weighted = true;  ///< false: each as if there were no other
  bool makes(int light_vertices, int eye_vertices) const {
    return connects && (s < 0 || s == light_vertices) && (t < 0 || t == eye_vertices);
  }
  bool merges() const { return s < 0 && t < 0; }
};

/// -D technique.
extern const EstimatorSetting kTechniqueSetting;

}  // namespace nephroid
