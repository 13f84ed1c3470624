// The merge radius in pixel footprints: the first one, and that of each pass of estimators without
// memory. It must not know photons.
#pragma once

#include <cstdint>

#include "integrator/estimator/integrator_options.h"
#include "scene/pixel_filter.h"

namespace nephroid {

/// [E5] The first radius over that of a small picture. `pixels` counts the uncropped picture, here
/// and below.
float radius_growth(int64_t pixels);
/// First radius: the user's, or the default, which grows with the picture.
float first_radius(const IntegratorOptions& options, int64_t pixels);
/// [E2] Radius of a pass.
float radius_of_pass(const IntegratorOptions& options, int64_t pixels, uint32_t pass);
/// The radius of a pass over the first radius.
float shrinkage(const IntegratorOptions& options, uint32_t pass);
/// [E5] A pass with x > 1 light paths for each pixel counts as x passes: the radius over that of a
/// pass with one. 1 if the user sets the radius.
float shrinkage_by_photons(const IntegratorOptions& options, double paths_of_pixel);

/// For EstimatorDescriptor::exposed_pixels: the number of pixels within the first radius. The
/// second function serves estimators that also splat light paths.
float pixels_of_merging(const IntegratorOptions& options, const PixelFilter& filter,
                        int64_t pixels);
float pixels_of_merging_and_splats(const IntegratorOptions& options, const PixelFilter& filter,
                                   int64_t pixels);

}  // namespace nephroid
