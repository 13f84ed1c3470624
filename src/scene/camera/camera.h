// Cameras: where the ray through a point of the film starts, where it goes, when, and how much of
// what it sees arrives. One kind a file; camera_table.cpp maps the scene format's names to them.
// Who calls it: transport, and the photon pass for its moment. It must not know routes or filters.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/errors.h"
#include "core/motion.h"
#include "input/scene_description.h"

namespace nephroid {

/// Width of a pixel's beam at a path length s from the film's lens: offset + spread * s. The first
/// merge radius is measured in it, never in world units.
struct PixelFootprint {
  float offset = 0;
  float spread = 0;
  float width(float path_length) const { return offset + spread * path_length; }
};

/// A ray into the scene and the factor of the radiance along it in the pixel's estimate: 1, or what
/// a lens system lets through over the density with which its pupil was sampled.
struct CameraRay {
  Ray ray;
  float weight = 1;
};

/// A straight line from a point of the scene to the lens, and where it exposes the film.
struct CameraConnection {
  Vec3f p;   ///< on the lens, world space
  Vec3f wi;  ///< unit, from the scene's point to the lens
  float distance = 0;
  Vec2f film;  ///< as generate_ray takes it; may lie outside of the picture
  /// Change of the film position, in pixels^2, per area perpendicular to wi at the scene's point.
  /// Flux that leaves the point along wi counts with it.
  float film_density = 0;
  float weight = 1;  ///< as CameraRay::weight
};

/// What a camera needs to know of its film.
struct CameraFilm {
  int width = 1, height = 1;  ///< pixels of the full resolution
  float diagonal_mm = 35;
};

/// Where a camera stands and when its shutter is open.
struct CameraPlacement {
  MotionTransform camera_to_world;
  /// In the scene's own time.
  float shutter_open = 0, shutter_close = 1;
  /// Moments of the two keyframes of everything that moves (TransformTimes).
  float keyframe_start = 0, keyframe_end = 1;
};

class Camera {
 public:
  explicit Camera(const CameraPlacement& placement) : placement_(placement) {}
  virtual ~Camera() = default;

  /// World ray with unit direction through `film` (pixels, y down, from the corner of the full
  /// resolution). `u_lens` chooses the point on the lens, `u_time` the moment within the shutter.
  /// Empty if the lens lets nothing through there: the sample counts and is black.
  virtual std::optional<CameraRay> generate_ray(const Vec2f& film, const Vec2f& u_lens,
                                                float u_time) const = 0;
  virtual PixelFootprint footprint() const = 0;

  /// Connects the world point `p` to the point of the lens that `u_lens` chooses (as generate_ray
  /// does) at the moment of `u_time`: generate_ray(film, u_lens, u_time) would be the ray back.
  /// Empty if `p` is behind the camera or exposes nothing, and for cameras that do not connect.
  virtual std::optional<CameraConnection> connect(const Vec3f& p, const Vec2f& u_lens,
                                                  float u_time) const = 0;
  /// False if light paths cannot be connected to this kind of camera (realistic lenses).
  virtual bool connects() const { return true; }
  /// Film points outside of the picture that see what `film`, inside, sees, those nearest to it;
  /// the rest of `out` is unused. Pictures that close upon themselves have some: a filter at their
  /// edge reaches over it. Returns how many.
  virtual int repeats(const Vec2f& /*film*/, std::span<Vec2f, 3> /*out*/) const { return 0; }

  /// The moment that u_time in [0,1) chooses within the shutter, as Ray::time counts: 0 at the
  /// first keyframe of what moves, 1 at the second, and no further [K2]. 0 if both are at the same
  /// time.
  virtual float motion_time(float u_time) const;
  /// Camera space (x right, y up, looking along +z) to world space at a Ray::time.
  Transform camera_to_world(float motion_time) const {
    return placement_.camera_to_world.at(motion_time);
  }

 protected:
  /// The ray from `o` along `d`, both in camera space, in world space with unit direction.
  Ray world_ray(const Vec3f& o, const Vec3f& d, float u_time) const;

  /// How a world point is seen from a point of the lens, whatever the transform does to lengths.
  struct Sight {
    Vec3f lens;               ///< world space
    Vec3f d;                  ///< unit, world space, from the lens to the point
    float distance = 0;       ///< world space
    Vec3f v;                  ///< d in camera space, not of unit length
    float camera_volume = 0;  ///< of a unit cube of world space in camera space
  };
  /// Empty if the point lies on the lens or the transform is flat at that moment.
  std::optional<Sight> see(const Vec3f& p, const Vec3f& lens, float u_time) const;

 private:
  CameraPlacement placement_;
};

/// Measures the beam of the pixel in the middle of the film: the rays through its centre and
/// through its neighbours' in x and y, all through the middle of the lens. Zero if these rays do
/// not exist.
PixelFootprint footprint_of_central_pixel(const Camera& camera, const CameraFilm& film);

/// Makes the camera of a scene. Without a description of one it is pbrt-v4's default, a perspective
/// camera of 90 degrees at the origin. Throws SceneError.
std::unique_ptr<Camera> make_camera(const SceneDescription& scene, const CameraFilm& film,
                                    Diagnostics& diagnostics);

}  // namespace nephroid
