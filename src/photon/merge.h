// Density estimation at one visible point: what the photons around it reflect towards the eye
// (docs/estimators.md, [M1] and [M2]).
// Who calls it: photon integrators. It must not know films or passes.
#pragma once

#include "film/part_sums.h"
#include "photon/photon_grid.h"
#include "route/scene_symbols.h"
#include "transport/random_walk.h"

namespace nephroid {

/// Photons whose surface is tilted against the visible point's by more than this do not count: they
/// lie on another wall.
inline constexpr float kMergeMinNormalCosine = 0.7f;

/// A point at which a camera walk gathers.
struct MergePoint {
  const WalkVertex& vertex;
  EyeState eye = 0;                      ///< of the eye side, this vertex excluded
  ClassMask classes = ClassMask::kNone;  ///< that have finite lobes here and may merge
  int events = 0;                        ///< of the eye side, this vertex included
  SampledSpectrum throughput;            ///< of the walk up to here
  bool secondary_terminated = false;     ///< the walk kept only its hero wavelength
};

/// How a photon arrives at a visible point.
struct PhotonArrival {
  Vec3f wi;  ///< local, on the side on which the photon arrived on its own surface
  float cos_geometric = 0;
};
/// Empty if the photon lies on another wall.
std::optional<PhotonArrival> arrival_at(const WalkVertex& vertex, const Photon& photon);

/// Adds throughput * sum of f * flux to the parts that own the photons' paths, to be divided by
/// (N pi r^2); returns how many photons counted. What belongs to other routes or makes the path
/// longer than `max_depth` events is passed over. A path that kept only the hero wavelength, on
/// either side, adds to lane 0 alone, times the number of wavelengths.
uint32_t merge_photons(const PhotonGrid& grid, const OwnedRoutes& owned, const MergePoint& at,
                       int max_depth, float radius, PartSums& sums);

}  // namespace nephroid
