// One pass of density estimation: photons are traced in batches that fit in memory, and one camera
// walk per pixel gathers them. It must not know how radii shrink from pass to pass.
#pragma once

#include <functional>
#include <vector>

#include "integrator/photons/photon_pass.h"

namespace nephroid {

/// Factor of the light merged at a point, with the radius in world units. Empty: 1.
using MergeWeight = std::function<float(const CameraPath&, const MergePoint&, float radius)>;

/// One estimate of each pixel: clamped to the film's max_component, then weighed by the filter.
struct MergePass {
  std::vector<Rgb> values;  ///< [pixel * parts + part], parts in the order of Film::parts_of
  std::vector<float> bias;  ///< [pixel] bias of [E4], not clamped
  uint64_t found = 0;       ///< photons merged
  static size_t bytes_per_pixel(size_t parts);
};

/// Renders a pass. The radius is `radius_pixels` footprints at the walk's path length. Adds rays
/// and photons to `statistics`.
MergePass merge_pass(const PassKey& key, const Scene& scene, const Film& film,
                     const OwnedRoutes& owned, const IntegratorOptions& options,
                     const PhotonGuide& guide, float radius_pixels, const MergeWeight& weight,
                     EstimatorStatistics& statistics, PassControl& control);

}  // namespace nephroid
