// The choice of techniques of a bidirectional estimator: all, or one alone.
#pragma once

#include "integrator/estimator/estimator_descriptor.h"

namespace nephroid {

struct TechniqueChoice {
  int s = -1, t = -1;    ///< number of light and of eye vertices; -1: any
  bool connects = true;  ///< false: merging alone
  bool weighted = true;  ///< false: each technique as if there were no other
  bool makes(int light_vertices, int eye_vertices) const {
    return connects && (s < 0 || s == light_vertices) && (t < 0 || t == eye_vertices);
  }
  bool merges() const { return s < 0 && t < 0; }
};

/// -D technique.
extern const EstimatorSetting kTechniqueSetting;

}  // namespace nephroid
