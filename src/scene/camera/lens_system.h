// A lens system of spherical surfaces and aperture stops along the optical axis: rays through it,
// focusing, and the exit pupil that a point of the film sees (pbrt-v4 section 5.4; Kolb, Mitchell &
// Hanrahan 1995). Camera space: the film at z = 0, the scene towards +z; metres.
// Who calls it: the realistic camera. It must not know pixels, scenes or files.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/math.h"

namespace nephroid {

class ApertureShape;

/// A surface of the system, as lens tables list them from the scene to the film.
struct LensSurface {
  double radius = 0;           ///< of curvature, positive if convex seen from the scene; 0: a stop
  double thickness = 0;        ///< along the axis to the next surface, or to the film
  double eta = 1;              ///< of the medium on the film's side
  double aperture_radius = 0;  ///< rays further from the axis are blocked
};

struct LensRay {
  Vec3d o, d;  ///< d need not be unit length
};

/// Rectangle on the plane through the rear surface's vertex; nothing gets through if it is empty.
struct PupilBounds {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double area() const { return (x1 - x0) * (y1 - y0); }
  bool empty() const { return !(x1 > x0 && y1 > y0); }
};

class LensSystem {
 public:
  /// `surfaces` from the scene to the film, at least one; `shape` of the stops, null: round.
  LensSystem(std::vector<LensSurface> surfaces, std::shared_ptr<const ApertureShape> shape);

  /// Moves the system along the axis until points at `distance` (m) before the film are in focus,
  /// by its thick-lens approximation at paraxial rays at height `x`. False, and nothing is moved,
  /// if no such ray gets through or the distance is too short for the lens.
  bool focus(double distance, double x);

  double rear_z() const { return surfaces_.back().thickness; }
  double front_z() const;
  double rear_radius() const { return surfaces_.back().aperture_radius; }

  /// The ray that leaves towards the scene, and the share of it (above 1 where the stop's shape is
  /// brighter than a round one) that the stops let through; empty if it is blocked.
  struct Passed {
    LensRay ray;
    float share = 1;
  };
  std::optional<Passed> trace_from_film(const LensRay& ray) const;
  /// The other way, through round stops.
  std::optional<LensRay> trace_from_scene(const LensRay& ray) const;

  /// A rectangle around all points of the rear plane through which light from film points at
  /// distances [x0, x1] from the axis, along +x, gets through. Holds for every turn of the stop's
  /// shape, so that it may be turned to other film points.
  PupilBounds bound_exit_pupil(double x0, double x1) const;

 private:
  bool reaches_scene(const LensRay& ray) const;

  std::vector<LensSurface> surfaces_;
  std::shared_ptr<const ApertureShape> shape_;
};

}  // namespace nephroid
