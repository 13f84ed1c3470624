// One pass of density estimation: photons are traced in batches that fit in memory, and a camera
// walk a pixel gathers them. It must not know how radii shrink from pass to pass.
#pragma once

#include <functional>
#include <vector>

#include "integrator/photons/photon_pass.h"

namespace nephroid {

/// A factor for what is merged at a point with a radius in world units; empty: 1.
using MergeWeight = std::function<float(const CameraPath&, const MergePoint&, float radius)>;

/// One estimate of each pixel: clamped to the film's max_component, then weighed by the filter.
struct MergePass {
  std::vector<Rgb> values;  ///< [pixel * parts + part], parts as Film::parts_of counts
  std::vector<float> bias;  ///< [pixel], [E4]; not clamped
  uint64_t found = 0;       ///< photons merged
  /// What it takes for each pixel.
  static size_t bytes_per_pixel(size_t parts);
};

/// The radius is `radius_pixels` footprints at the length of the walk. Adds rays and photons to
/// `statistics`.
MergePass merge_pass(const PassKey& key, const Scene& scene, const Film& film,
                     const OwnedRoutes& owned, const IntegratorOptions& options,
                     const PhotonGuide& guide, float radius_pixels, const MergeWeight& weight,
                     EstimatorStatistics& statistics, PassControl& control);

}  // namespace nephroid
