// A first picture for those who wait: some pixels, path-traced, before an algorithm has learned
// and has traced its photons. Nothing of it is kept. It must not know when it is called for.
#pragma once

#include <functional>
#include <string>

#include "integrator/presets/estimator_set.h"
#include "session/signals.h"

namespace nephroid {

/// A scene to look at, and where to put what is seen.
struct QuickLook {
  const Scene& scene;
  int max_depth = 100;  ///< scattering events of a path
  uint64_t seed = 0;
  std::string output;  ///< the EXR beside which the PNG goes
  float exposure = 1;
};

/// True if the estimators have work to do before they know a pixel, and the picture is not so small
/// that it is soon done.
bool is_worth_a_quick_look(const EstimatorSet& set, const FilmFormat& film);

/// Path-traces the first lattice of the picture, one path a pixel, and writes the PNG; after one
/// second of `now` or at a signal what is there, or nothing if that says too little. Throws
/// IoError.
void take_quick_look(const QuickLook& look, const SignalFlags& signals,
                     const std::function<double()>& now);

}  // namespace nephroid
