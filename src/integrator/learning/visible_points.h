// Camera walks before any photon is traced: visible points, near which photons are useful, and
// casters, specular objects between rough surfaces and light. It must not know guides.
#pragma once

#include <vector>

#include "integrator/photons/photon_pass.h"
#include "photon/photon_grid.h"

namespace nephroid {

/// Visible points, stored as photons, and the radius around them in which light counts as seen.
struct VisiblePoints {
  PhotonGrid grid;
  PixelFootprint footprint;
  Vec3f eye{0, 0, 0};
  float radius_pixels = 0;
  uint64_t rays = 0;  ///< rays of the camera walks

  /// True if light that arrives at `p` (world) would be seen.
  bool has_near(const Vec3f& p) const {
    bool any = false;
    grid.query(p, radius_pixels * footprint.width(length(p - eye)),
               [&](const Photon&, float) { any = true; });
    return any;
  }
};

/// Points where about 2^13 camera walks of the pass would merge photons of the group.
VisiblePoints visible_points(const Scene& scene, const FilmFormat& film, const OwnedRoutes& owned,
                             const PhotonPass& pass, const IntegratorOptions& options);

struct CausticCasters {
  std::vector<Vec3f> points;
  uint64_t rays = 0;  ///< rays of the camera walks
};
/// World points at which light would first meet a caster on its way to a rough vertex. They are the
/// last vertices of runs of S behind a D, G or V, from about 2^13 camera walks with at most three
/// such vertices.
CausticCasters caustic_casters(const Scene& scene, const FilmFormat& film, const PhotonPass& pass,
                               const IntegratorOptions& options);

}  // namespace nephroid
