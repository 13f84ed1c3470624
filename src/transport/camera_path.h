// The start of a camera path: film position, filter weight, lens, time and wavelengths of a pixel's
// sample.
#pragma once

#include "core/color.h"
#include "scene/camera/camera.h"
#include "scene/pixel_filter.h"
#include "transport/random_walk.h"

namespace nephroid {

struct CameraPath {
  Walk walk;
  Vec2f film, u_lens;  ///< arguments of Camera::generate_ray
  float u_time = 0;
  float filter_weight = 1;  ///< may be negative
  /// The camera's weight of all light along the path. 0 if the lens lets nothing through: then
  /// there is no walk, and the sample is black. It stays out of the throughput, where roulette
  /// would see it.
  float camera_weight = 0;
};

/// The number in [0,1) that chooses the wavelengths of a path or a pass: `u`, or 0.5 if the scene
/// turns wavelength jitter off.
inline float wavelength_number(const Scene& scene, float u) {
  return scene.options.wavelength_jitter ? u : 0.5f;
}

/// Starts a path through the film point `film`, in pixels. `lambda` and `u_time`, in [0,1), belong
/// to the path, or to the pass if paths share them.
inline CameraPath start_camera_path(const Scene& scene, const Vec2f& film, PathSampler& sampler,
                                    const SampledWavelengths& lambda, float u_time) {
  CameraPath path;
  sampler.start_dimension(dimensions::kLens);
  path.u_lens = sampler.get_2d();
  path.u_time = u_time;
  path.film = film;
  path.walk.lambda = lambda;
  path.walk.medium = scene.camera_medium;
  const std::optional<CameraRay> start = scene.camera->generate_ray(path.film, path.u_lens, u_time);
  if (!start) return path;
  path.camera_weight = start->weight;
  path.walk.ray = start->ray;
  path.walk.previous_p = path.walk.ray.o;
  return path;
}

/// Starts a path through a point sampled from the filter of pixel (x, y).
inline CameraPath start_camera_path(const Scene& scene, int x, int y, PathSampler& sampler,
                                    const SampledWavelengths& lambda, float u_time) {
  sampler.start_dimension(dimensions::kFilm);
  PixelFilter::Sample f = scene.filter->sample(sampler.get_2d());
  if (!scene.options.pixel_jitter) f = {Vec2f(0, 0), 1.0f};
  CameraPath path = start_camera_path(
      scene,
      Vec2f(static_cast<float>(x) + 0.5f + f.offset.x, static_cast<float>(y) + 0.5f + f.offset.y),
      sampler, lambda, u_time);
  path.filter_weight = f.weight;
  return path;
}

}  // namespace nephroid
