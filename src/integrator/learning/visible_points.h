// What a first look from the camera tells about light paths before any is traced: where photons
// would be seen, and which specular things stand where light could come from. It must not know
// guides.
#pragma once

#include <vector>

#include "integrator/photons/photon_pass.h"
#include "photon/photon_grid.h"

namespace nephroid {

/// What the camera sees: points on surfaces, as photons, and how far around one light counts.
struct VisiblePoints {
  PhotonGrid grid;
  PixelFootprint footprint;
  Vec3f eye{0, 0, 0};
  float radius_pixels = 0;
  uint64_t rays = 0;  ///< that it took

  /// True if light that arrives at `p` (world) would be seen.
  bool has_near(const Vec3f& p) const {
    bool any = false;
    grid.query(p, radius_pixels * footprint.width(length(p - eye)),
               [&](const Photon&, float) { any = true; });
    return any;
  }
};

/// Points where camera walks of the pass would merge photons of the group, of about 2^13 walks.
VisiblePoints visible_points(const Scene& scene, const FilmFormat& film, const OwnedRoutes& owned,
                             const PhotonPass& pass, const IntegratorOptions& options);

struct CausticCasters {
  std::vector<Vec3f> points;
  uint64_t rays = 0;  ///< that it took
};
/// Points (world) at which light that reaches a rough vertex of a camera path by way of specular
/// ones may have met the first of these: the last vertices of runs of S behind a D, G or V, of
/// paths of as many walks with at most three such vertices.
CausticCasters caustic_casters(const Scene& scene, const FilmFormat& film, const PhotonPass& pass,
                               const IntegratorOptions& options);

}  // namespace nephroid
