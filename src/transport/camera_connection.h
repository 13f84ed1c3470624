// From a vertex of a light path to the camera: the points of the picture that a straight line to
// the lens exposes, and what gets along it. Who calls it: estimators that connect light to the
// camera. It must not know routes.
#pragma once

#include <array>
#include <optional>

#include "film/film.h"
#include "scene/camera/camera.h"
#include "scene/pixel_filter.h"
#include "transport/random_walk.h"

namespace nephroid {

/// A connection and the film points that it exposes: several where the picture closes upon itself.
struct Exposure {
  CameraConnection line;
  std::array<Vec2f, 4> film;
  int count = 0;
};

/// What a film sees of the scene through its camera. Refers to both.
class CameraView {
 public:
  CameraView(const Scene& scene, const PixelBounds& crop);

  /// Connects `p` to the lens. Empty if no pixel of the crop has a filter that reaches the film
  /// point. `u_lens` and `u_time` as Camera::connect.
  std::optional<Exposure> connect(const Vec3f& p, const Vec2f& u_lens, float u_time) const;

 private:
  bool reaches(const Vec2f& film) const {
    return film.x > low_.x && film.x < high_.x && film.y > low_.y && film.y < high_.y;
  }
  const Camera& camera_;
  Vec2f low_, high_;  ///< of film points that matter
};

/// Share of light that gets from `origin`, already off its surface and in `medium`, to the lens,
/// right for each wavelength by itself. Random numbers come from the sampler's current dimension.
SampledSpectrum attenuation_to_camera(const Scene& scene, const Vec3f& origin, float time,
                                      const Medium* medium, const CameraConnection& line,
                                      const SampledWavelengths& lambda, const PathSampler& sampler);

}  // namespace nephroid
