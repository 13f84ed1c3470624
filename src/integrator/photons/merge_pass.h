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

/// First merge radius in footprints, of a picture of so many pixels (FilmFormat::picture_pixels):
/// the user's, or one that grows with the picture ([E5]).
float first_radius(const IntegratorOptions& options, int64_t pixels);
/// How much wider the first radius is than that of a small picture.
float radius_growth(int64_t pixels);
/// For EstimatorDescriptor::exposed_pixels: pixels within that radius, and the same where light
/// paths are splatted as well.
float pixels_of_merging(const IntegratorOptions& options, const PixelFilter& filter,
                        int64_t pixels);
float pixels_of_merging_and_splats(const IntegratorOptions& options, const PixelFilter& filter,
                                   int64_t pixels);
/// The radius of a pass by [E2], in footprints.
float radius_of_pass(const IntegratorOptions& options, int64_t pixels, uint32_t pass);

}  // namespace nephroid
