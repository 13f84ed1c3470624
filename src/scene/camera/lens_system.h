// A lens system of spherical surfaces and aperture stops along the optical axis: tracing, focusing,
// and the exit pupil of a film point. Camera space: the film at z = 0, the scene towards +z;
// metres. It must not know pixels, scenes or files. Sources: Kolb, Mitchell & Hanrahan 1995;
// pbrt-v4 section 5.4.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/math.h"

namespace nephroid {

class ApertureShape;

/// A surface of the system, in the order of lens tables: from the scene to the film.
struct LensSurface {
  double radius = 0;           ///< radius of curvature, positive if convex towards the scene; 0: a
                               ///< stop
  double thickness = 0;        ///< distance along the axis to the next surface, or to the film
  double eta = 1;              ///< index of refraction on the film's side
  double aperture_radius = 0;  ///< radius beyond which rays are blocked
};

struct LensRay {
  Vec3d o, d;  ///< d need not be of unit length
};

/// Rectangle on the plane through the rear surface's vertex. Empty if no light passes.
struct PupilBounds {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double area() const { return (x1 - x0) * (y1 - y0); }
  bool empty() const { return !(x1 > x0 && y1 > y0); }
};

class LensSystem {
 public:
  /// `surfaces` from the scene to the film, at least one. `shape` of the stops; null: round.
  LensSystem(std::vector<LensSurface> surfaces, std::shared_ptr<const ApertureShape> shape);

  /// Moves the system along the axis to focus at `distance` (m) from the film, by the thick-lens
  /// approximation with paraxial rays at height `x`. False, and nothing moves, if no such ray
  /// passes or the distance is too short for the lens.
  bool focus(double distance, double x);

  double rear_z() const { return surfaces_.back().thickness; }
  double front_z() const;
  double rear_radius() const { return surfaces_.back().aperture_radius; }

  /// The ray that leaves towards the scene, and the share that the stops transmit (above 1 where
  /// the stop's shape is brighter than a round one). Empty if it is blocked.
  struct Passed {
    LensRay ray;
    float share = 1;
  };
  std::optional<Passed> trace_from_film(const LensRay& ray) const;
  /// Traces from the scene to the film, with round stops.
  std::optional<LensRay> trace_from_scene(const LensRay& ray) const;

  /// A rectangle around all points of the rear plane that transmit light from film points at
  /// distances [x0, x1] from the axis, along +x. It holds for every rotation of the stop's shape,
  /// so it can be rotated to other film points.
  PupilBounds bound_exit_pupil(double x0, double x1) const;

 private:
  bool reaches_scene(const LensRay& ray) const;

  std::vector<LensSurface> surfaces_;
  std::shared_ptr<const ApertureShape> shape_;
};

}  // namespace nephroid
