// One pass of walks from the camera, each pixel with wavelengths and a time of its own: the loop
// over pixels that estimators which trace paths from the eye share. It must not know what walks do.
#pragma once

#include <vector>

#include "core/parallel.h"
#include "film/part_sums.h"
#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"
#include "transport/camera_path.h"
#include "transport/path_points.h"
#include "transport/roughness_band.h"

namespace nephroid {

/// What the walks of a pass share.
struct PathPass {
  const PassKey& key;
  const Scene& scene;
  Film& film;
  const OwnedRoutes& owned;
  int samples = 1;      ///< of each pixel
  uint64_t stream = 0;  ///< of random numbers

  SensorWeights weights_of(const CameraPath& path) const {
    const FilmSettings& settings = film.settings();
    return sensor_weights(path.walk.lambda, *settings.color_space, settings.imaging_ratio,
                          settings.white_balance);
  }
};

/// Calls trace(x, y, CameraPath&, const SensorWeights&, PathSampler&, PartSums&) -> rays for each
/// sample of each pixel and adds the light that it finds to the film. The weights, and with them
/// the light, are of the wavelengths that the path starts with. Returns all rays.
template <class Trace>
uint64_t trace_paths(const PathPass& pass, Trace&& trace) {
  const PixelBounds& b = pass.film.bounds();
  const float specular_alpha = specular_alpha_of_pass(pass.scene.specular_band, pass.key);
  const int group = static_cast<int>(pass.owned.group);
  uint64_t all_rays = 0;
  for (int k = 0; k < pass.samples; ++k) {
    const uint64_t index = uint64_t{pass.key.pass} * pass.samples + k;
    const SobolPoint point = eye_point(static_cast<uint32_t>(index));
    const auto trace_row = [&](uint64_t& rays, int64_t row, int64_t) {
      const int y = b.y0 + static_cast<int>(row);
      PartSums light(*pass.owned.routes, pass.owned.group);
      for (int x = b.x0; x < b.x1; ++x) {
        PathSampler sampler(point, hash_combine(pass.key.seed, pass.stream, x, y, index >> 32));
        sampler.start_dimension(dimensions::kWavelength);
        const SampledWavelengths lambda =
            SampledWavelengths::sample_visible(wavelength_number(pass.scene, sampler.get_1d()));
        sampler.start_dimension(dimensions::kTime);
        CameraPath path = start_camera_path(pass.scene, x, y, sampler, lambda, sampler.get_1d());
        path.walk.specular_alpha = specular_alpha;
        path.walk.roulette_threshold = kCameraRouletteThreshold;
        light.clear();
        const SensorWeights weights = pass.weights_of(path);
        rays += trace(x, y, path, weights, sampler, light);
        pass.film.add(group, x, y,
                      light.colors(weights, path.camera_weight, pass.film.settings().max_component,
                                   path.filter_weight));
      }
    };
    ordered_reduce<uint64_t>(b.height(), 1, trace_row,
                             [&](uint64_t&& of_row) { all_rays += of_row; });
    pass.film.add_estimates(group, 1);
  }
  return all_rays;
}

}  // namespace nephroid
