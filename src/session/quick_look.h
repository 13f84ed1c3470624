// A quick first preview: some pixels, path-traced, before an estimator has learned and traced its
// photons. The render does not keep them. It must not know when it is needed.
#pragma once

#include <functional>

#include "integrator/presets/estimator_set.h"
#include "session/signals.h"

namespace nephroid {

/// The scene of a quick look, and what shows its film.
struct QuickLook {
  const Scene& scene;
  int max_depth = 100;  ///< scattering events of a path
  uint64_t seed = 0;
  std::function<void(const Film&)> show;
};

/// True if an estimator starts at lights, so that its first pixels take long, and the picture is
/// large.
bool is_worth_a_quick_look(const EstimatorSet& set, const FilmFormat& film);

/// Path-traces the first lattice of the picture, one path a pixel, and shows it. Stops after one
/// second of `now` or at a signal; then it shows the film only if that can be shown.
void take_quick_look(const QuickLook& look, const SignalFlags& signals,
                     const std::function<double()>& now);

}  // namespace nephroid
