// Cameras: where the ray through a point of the film starts and where it goes.
// Who calls it: transport. It must not know films, routes or filters.
#pragma once

#include <memory>

#include "core/errors.h"
#include "core/math.h"
#include "input/scene_description.h"

namespace nephroid {

/// Width of a pixel's beam at a path length s from the film's lens: offset + spread * s. The first
/// merge radius is measured in it, never in world units.
struct PixelFootprint {
  float offset = 0;
  float spread = 0;
  float width(float path_length) const { return offset + spread * path_length; }
};

class Camera {
 public:
  virtual ~Camera() = default;
  /// World ray with unit direction through `film` (pixels, y down, from the corner of the full
  /// resolution). `u_lens` chooses the point on the lens, `u_time` the moment within the shutter.
  virtual Ray generate_ray(const Vec2f& film, const Vec2f& u_lens, float u_time) const = 0;
  virtual PixelFootprint footprint() const = 0;
};

/// Makes the camera of a scene for a film of `width` x `height` pixels. Without a description it is
/// pbrt-v4's default, a perspective camera of 90 degrees at the origin. Throws SceneError.
std::unique_ptr<Camera> make_camera(const std::optional<CameraDescription>& description, int width,
                                    int height, Diagnostics& diagnostics);

}  // namespace nephroid
