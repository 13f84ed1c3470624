// Density estimation at one visible point: what the photons around it reflect towards the eye
// (docs/estimators.md, [M1] and [M2]).
// Who calls it: photon integrators. It must not know films or passes.
#pragma once

#include "photon/photon_grid.h"
#include "transport/random_walk.h"

namespace nephroid {

/// Photons whose surface is tilted against the visible point's by more than this do not count: they
/// lie on another wall.
inline constexpr float kMergeMinNormalCosine = 0.7f;

struct MergeResult {
  SampledSpectrum reflected;  ///< sum of f_D * flux, to be divided by (N pi r^2)
  SampledSpectrum hero;       ///< the same for photons that kept only the hero wavelength: lane 0,
                         ///< already multiplied by the number of wavelengths
  uint32_t found = 0;  ///< photons that counted
};

/// Gathers at a vertex whose D lobes merge. `eye` is the state of the eye side, this D included;
/// `eye_events` the events of the eye side, this vertex included. Photons that belong to another
/// route or make the path longer than `max_depth` events are passed over.
MergeResult merge_photons(const PhotonGrid& grid, const Routes& routes, Route route,
                          const WalkVertex& vertex, EyeState eye, int eye_events, int max_depth,
                          bool eye_terminated, float radius);

}  // namespace nephroid
