// Cameras map film points to rays: origin, direction, time, and weight of the radiance. One file
// per camera type; camera_table.cpp maps the scene format's names to them. It must not know routes
// or filters.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/errors.h"
#include "core/motion.h"
#include "input/scene_description.h"

namespace nephroid {

/// Width of a pixel's beam at path length s from the lens: offset + spread * s. The first merge
/// radius is measured in it, never in world units.
struct PixelFootprint {
  float offset = 0;
  float spread = 0;
  float width(float path_length) const { return offset + spread * path_length; }
};

/// A ray into the scene, and the weight of its radiance in the pixel's estimate: 1, or for lens
/// systems the transmitted share over the density of the pupil sample.
struct CameraRay {
  Ray ray;
  float weight = 1;
};

/// A straight line from a point of the scene to the lens, with the film position that it exposes.
struct CameraConnection {
  Vec3f p;   ///< on the lens, world space
  Vec3f wi;  ///< unit, from the scene point to the lens
  float distance = 0;
  Vec2f film;  ///< same units as in generate_ray; can lie outside of the picture
  /// Change of film position, in pixels^2, per area perpendicular to wi at the scene point. It
  /// multiplies the flux that leaves the point along wi.
  float film_density = 0;
  float weight = 1;  ///< same as CameraRay::weight
};

/// The film's properties that a camera needs.
struct CameraFilm {
  int width = 1, height = 1;  ///< pixels at full resolution
  float diagonal_mm = 35;
};

/// A camera's position and the time its shutter is open.
struct CameraPlacement {
  MotionTransform camera_to_world;
  /// In the scene's time units.
  float shutter_open = 0, shutter_close = 1;
  /// Times of the two keyframes of everything that moves (TransformTimes).
  float keyframe_start = 0, keyframe_end = 1;

  /// Maps u_time in [0,1) to the shutter, as a Ray::time: 0 at the first keyframe of what moves, 1
  /// at the second, clamped [K2]. 0 if both keyframes are at the same time.
  float motion_time(float u_time) const;
};

class Camera {
 public:
  explicit Camera(const CameraPlacement& placement) : placement_(placement) {}
  virtual ~Camera() = default;

  /// World ray with unit direction through `film` (pixels, y down, from the corner of the full
  /// resolution). `u_lens` samples the lens, `u_time` the shutter time. Empty if the lens transmits
  /// nothing there: the sample counts and is black.
  virtual std::optional<CameraRay> generate_ray(const Vec2f& film, const Vec2f& u_lens,
                                                float u_time) const = 0;
  virtual PixelFootprint footprint() const = 0;

  /// Connects the world point `p` to the lens point sampled by `u_lens` (as in generate_ray) at the
  /// time of `u_time`: generate_ray(film, u_lens, u_time) is the ray back. Empty if `p` is behind
  /// the camera or exposes nothing, and for cameras that do not connect.
  virtual std::optional<CameraConnection> connect(const Vec3f& p, const Vec2f& u_lens,
                                                  float u_time) const = 0;
  /// False if light paths cannot be connected to this camera type (realistic lenses).
  virtual bool connects() const { return true; }
  /// Film points outside of the picture, those nearest to it, that see the same as `film`, inside.
  /// Pictures that wrap around have some, because a filter at an edge reaches across it. Returns
  /// their number; the rest of `out` is unused.
  virtual int repeats(const Vec2f& /*film*/, std::span<Vec2f, 3> /*out*/) const { return 0; }

  /// CameraPlacement::motion_time of its placement.
  virtual float motion_time(float u_time) const { return placement_.motion_time(u_time); }
  /// Camera space (x right, y up, looking along +z) to world space at a Ray::time.
  Transform camera_to_world(float motion_time) const {
    return placement_.camera_to_world.at(motion_time);
  }

 protected:
  /// Transforms the ray from `o` along `d` from camera space to world space, with unit direction.
  Ray world_ray(const Vec3f& o, const Vec3f& d, float u_time) const;

  /// A world point as seen from a lens point, under any scaling by the transform.
  struct Sight {
    Vec3f lens;               ///< world space
    Vec3f d;                  ///< unit, world space, from the lens to the point
    float distance = 0;       ///< world space
    Vec3f v;                  ///< d in camera space, not normalised
    float camera_volume = 0;  ///< volume in camera space of a unit cube of world space
  };
  /// Empty if the point lies on the lens or the transform is singular at that time.
  std::optional<Sight> see(const Vec3f& p, const Vec3f& lens, float u_time) const;

 private:
  CameraPlacement placement_;
};

/// Measures the beam of the central pixel: the rays through its centre and through those of its
/// neighbours in x and y, all through the middle of the lens. Zero if these rays do not exist.
PixelFootprint footprint_of_central_pixel(const Camera& camera, const CameraFilm& film);

/// The placement of the scene's camera; at the origin without one. Throws SceneError.
CameraPlacement camera_placement(const SceneDescription& scene);

/// Makes the scene's camera, by default pbrt-v4's: a perspective camera of 90 degrees at the
/// origin. Throws SceneError.
std::unique_ptr<Camera> make_camera(const SceneDescription& scene, const CameraFilm& film,
                                    Diagnostics& diagnostics);

}  // namespace nephroid
