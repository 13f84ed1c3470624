// One pass of camera walks: the loop over pixels, shared by estimators that trace paths from the
// eye. Each sample has its own wavelengths and time. It must not know what walks do.
#pragma once

#include <vector>

#include "film/part_sums.h"
#include "integrator/estimator/estimator.h"
#include "integrator/estimator/lamp_counter.h"
#include "integrator/estimator/slice_loop.h"
#include "route/scene_symbols.h"
#include "transport/camera_path.h"
#include "transport/path_points.h"
#include "transport/roughness_band.h"

namespace nephroid {

inline SensorWeights sensor_weights_of(const CameraPath& path, const FilmSettings& film) {
  return sensor_weights(path.walk.lambda, *film.color_space, film.imaging_ratio,
                        film.white_balance);
}

/// Settings shared by the walks of a pass.
struct PathPass {
  const PassKey& key;
  const Scene& scene;
  Film& film;
  const OwnedRoutes& owned;
  int samples = 1;      ///< samples per pixel
  uint64_t stream = 0;  ///< stream of random numbers
  PassControl& control;
  bool adds_features = false;    ///< `trace` adds the features of its sample
  LampCounter* lamps = nullptr;  ///< null: lamps are not told apart

  SensorWeights weights_of(const CameraPath& path) const {
    return sensor_weights_of(path, film.settings());
  }
};

/// Starts a path of a pixel with wavelengths and a time of its own.
inline CameraPath start_own_path(const Scene& scene, int x, int y, float specular_alpha,
                                 PathSampler& sampler) {
  sampler.start_dimension(dimensions::kWavelength);
  const SampledWavelengths lambda =
      SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
  sampler.start_dimension(dimensions::kTime);
  CameraPath path = start_camera_path(scene, x, y, sampler, lambda, sampler.get_1d());
  path.walk.specular_alpha = specular_alpha;
  path.walk.roulette_threshold = kCameraRouletteThreshold;
  return path;
}

/// Calls trace(x, y, CameraPath&, const SensorWeights&, PathSampler&, PartSums&) -> rays for each
/// sample of each pixel and adds the light that it finds to the film. Weights and light belong to
/// the wavelengths that the path starts with. Returns the number of rays.
template <class Trace>
uint64_t trace_paths(const PathPass& pass, Trace&& trace) {
  const float specular_alpha = specular_alpha_of_pass(pass.scene.specular_band, pass.key);
  const int group = static_cast<int>(pass.owned.group);
  const uint64_t first = uint64_t{pass.key.pass} * pass.samples;
  std::vector<SobolPoint> points;
  for (int k = 0; k < pass.samples; ++k)
    points.push_back(eye_point(static_cast<uint32_t>(first + k)));
  const auto trace_sample = [&](int x, int y, int k, PartSums& light, LampCounter::Slice& lamps) {
    const uint64_t turn = (first + k) >> 32;
    PathSampler sampler(points[k], hash_combine(pass.key.seed, pass.stream, x, y, turn));
    CameraPath path = start_own_path(pass.scene, x, y, specular_alpha, sampler);
    light.clear();
    const SensorWeights weights = pass.weights_of(path);
    const uint64_t rays = trace(x, y, path, weights, sampler, light);
    lamps.take(weights,
               static_cast<double>(path.camera_weight) * path.filter_weight / pass.samples);
    pass.film.add(group, x, y,
                  light.colors(weights, path.camera_weight, pass.film.settings().max_component,
                               path.filter_weight));
    return rays;
  };
  const uint64_t samples = pass.samples;
  const SlicesOfPass slices{.film = pass.film,
                            .group = group,
                            .estimates = samples,
                            .feature_estimates = pass.adds_features ? samples : 0};
  uint64_t all_rays = 0;
  slices.render<uint64_t>(
      pass.control,
      [&](uint64_t& rays, const PixelSlices::Run& run) {
        PartSums light(*pass.owned.routes, pass.owned.group);
        LampCounter::Slice lamps(pass.lamps, light);
        for (int i = 0; i < run.count; ++i)
          for (int k = 0; k < pass.samples; ++k)
            rays += trace_sample(run.x + i * run.step, run.y, k, light, lamps);
      },
      [&](uint64_t&& rays) { all_rays += rays; });
  return all_rays;
}

}  // namespace nephroid
