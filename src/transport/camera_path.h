// The start of a camera path: film position, filter weight, lens, time and wavelengths of a pixel's
// sample.
#pragma once

#include "core/color.h"
#include "scene/camera.h"
#include "scene/pixel_filter.h"
#include "transport/random_walk.h"

namespace nephroid {

struct CameraPath {
  Walk walk;
  float filter_weight = 1;  ///< may be negative
};

/// Starts a path through pixel (x, y). `lambda` is the path's, or the pass's where it is shared;
/// `u_time` likewise.
inline CameraPath start_camera_path(const Scene& scene, int x, int y, PathSampler& sampler,
                                    const SampledWavelengths& lambda, float u_time) {
  CameraPath path;
  sampler.start_dimension(dimensions::kFilm);
  const PixelFilter::Sample f = scene.filter->sample(sampler.get_2d());
  sampler.start_dimension(dimensions::kLens);
  const Vec2f u_lens = sampler.get_2d();
  const Vec2f film(static_cast<float>(x) + 0.5f + f.offset.x,
                   static_cast<float>(y) + 0.5f + f.offset.y);
  path.filter_weight = f.weight;
  path.walk.ray = scene.camera->generate_ray(film, u_lens, u_time);
  path.walk.lambda = lambda;
  path.walk.medium = scene.camera_medium;
  path.walk.previous_p = path.walk.ray.o;
  return path;
}

}  // namespace nephroid
