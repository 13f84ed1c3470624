#include "integrator/photons/merge_radius.h"

#include <algorithm>
#include <cmath>

#include "film/pixel_slices.h"
#include "integrator/estimator/exposed_pixels.h"
#include "photon/radius_schedule.h"

namespace nephroid {

namespace {

/// r_0 of [E5], the first radius in a picture of at most PixelSlices::kMaxFirstPixels pixels.
constexpr float kDefaultMergeRadius = 1.5f;

}  // namespace

float radius_growth(int64_t pixels) {
  const double over_thumbnail =
      static_cast<double>(pixels) / static_cast<double>(PixelSlices::kMaxFirstPixels);
  return static_cast<float>(std::pow(std::max(1.0, over_thumbnail), 0.3));
}

float first_radius(const IntegratorOptions& options, int64_t pixels) {
  return options.radius > 0 ? options.radius : kDefaultMergeRadius * radius_growth(pixels);
}

float pixels_of_merging(const IntegratorOptions& options, const PixelFilter&, int64_t pixels) {
  return pixels_within(first_radius(options, pixels));
}

float pixels_of_merging_and_splats(const IntegratorOptions& options, const PixelFilter& filter,
                                   int64_t pixels) {
  return std::max(pixels_within(first_radius(options, pixels)), splatted_pixels(filter));
}

float radius_of_pass(const IntegratorOptions& options, int64_t pixels, uint32_t pass) {
  return first_radius(options, pixels) * shrinkage(options, pass);
}

float shrinkage(const IntegratorOptions& options, uint32_t pass) {
  return static_cast<float>(std::sqrt(memoryless_radius_squared(pass, options.shrink_alpha)));
}

float shrinkage_by_photons(const IntegratorOptions& options, double paths_of_pixel) {
  if (options.radius > 0 || !(paths_of_pixel > 1)) return 1;
  return static_cast<float>(std::pow(paths_of_pixel, (options.shrink_alpha - 1) / 2));
}

}  // namespace nephroid
